// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/angles.h"
#include "instruments/compass_calibration.h"
#include "instruments/tcm2_dialogue.h"
#include "instruments/turn_count.h"
#include "instruments/units.h"
#include "protocols/tcm2.h"
#include "protocols/tcm2_commands.h"
#include "protocols/tcm2_reply.h"

namespace navcal::instruments {
namespace {

namespace tcm2 = protocols::tcm2;
using tcm2::Parameter;
using tcm2::Verb;

constexpr double kTurns_rad = 2 * 2 * std::numbers::pi;
/// Longest gap between two gyro rates that is integrated over.
constexpr std::int64_t kLongestRateGap_ns = 500 * base::kMillisecond_ns;

/// The TCM2's own calibration (ICD section 1): `h` twice, `cc`, `mpcal=e`, `go`. The vehicle then makes two
/// slow turns with as much tilt as possible. At the end, or when the time for it is over: `h` twice, `mpcal=d`,
/// which answers the score (otherwise `lc?` does), `go`.
class Tcm2Calibration final : public CompassCalibration {
 public:
  Tcm2Calibration(const config::PortSettings& settings, std::int64_t longest_ns)
      : heading_unit_(settings.compass.heading_unit), longest_ns_(longest_ns),
        stopped_after_ns_(stopped_after_ns(settings.rate_Hz, kTcm2Stopped_ns)) {}

  [[nodiscard]] std::string_view name() const override { return "tcm2"; }
  [[nodiscard]] std::string_view manoeuvre() const override {
    return "turn twice, slowly, with as much tilt as possible";
  }
  std::string save(std::int64_t) override {
    return "the TCM2 applies its calibration itself: there is nothing to accept or to roll back";
  }
  /// Without a gyro, the compass that is being calibrated counts the turns.
  void on_yaw_rate(double rate_rad_s, std::int64_t now_ns) override {
    if (!turning_) return;
    const std::int64_t since_ns = gyro_ns_ ? now_ns - *gyro_ns_ : 0;
    gyro_ns_ = now_ns;
    if (since_ns < kLongestRateGap_ns) gyro_angle_rad_ += rate_rad_s * static_cast<double>(since_ns) * 1e-9;
    by_gyro_.add(gyro_angle_rad_);
  }
  [[nodiscard]] std::vector<Figure> figures() const override {
    if (!score_) return {};
    return {{"horizontal", static_cast<double>(score_->horizontal)},
            {"vertical", static_cast<double>(score_->vertical)},
            {"magnitude", score_->magnitude}};
  }

 private:
  Script script() override {
    const auto is_word = [this](const protocols::Frame& frame) { return count_word(frame); };
    if (part_ == Part::calibrating) {
      doing_ = "preparing the compass";
      co_await send(tcm2::encode_command({Verb::halt}), kBetweenHalts_ns);
      co_await send(tcm2::encode_command({Verb::halt}), kSettle_ns);
      touched_ = true;
      asked_ = "cc";
      if (!co_await ask(tcm2::encode_command({Verb::clear_calibration}), kAttempts, kReplyTimeout_ns, replies_))
        fail("no answer to cc");
      if (failure().empty()) {
        may_calibrate_ = true;
        asked_ = "mpcal=e";
        if (!co_await ask(multipoint('e'), kAttempts, kReplyTimeout_ns, replies_)) fail("no answer to mpcal=e");
      }
      if (failure().empty()) {
        if (!co_await ask(tcm2::encode_command({Verb::go}), kAttempts, stopped_after_ns_, is_word))
          fail("no words came after go");
        turning_ = failure().empty();
      }
      const std::int64_t ends_ns = now_ns() + longest_ns_;
      while (turning_ && turned_rad() < kTurns_rad && now_ns() < ends_ns) {
        if (!co_await wait(std::min(stopped_after_ns_, ends_ns - now_ns()), is_word) && now_ns() < ends_ns) {
          fail("its words have stopped");
          turning_ = false;
        }
      }
      turning_ = false;
      part_ = after_turning();
    }
    if (part_ == Part::closing) {
      doing_ = "reading the score";
      co_await send(tcm2::encode_command({Verb::halt}), kBetweenHalts_ns);
      co_await send(tcm2::encode_command({Verb::halt}), kSettle_ns);
      // Unanswered, the command may have been obeyed all the same: the score will show it.
      asked_ = "mpcal=d";
      co_await ask(multipoint('d'), kAttempts, kReplyTimeout_ns, replies_);
      if (failure().empty() && !score_) {
        asked_ = "lc?";
        if (!co_await ask(tcm2::encode_command({Verb::calibration_score}), kAttempts, kReplyTimeout_ns, replies_))
          fail("no answer to lc?");
      }
      part_ = Part::resuming;
    }
    doing_ = "putting the compass back to service";
    // After a silence, StartUp begins anew.
    if (!co_await ask(tcm2::encode_command({Verb::go}), kAttempts, stopped_after_ns_, is_word))
      fail("no words came after it");
  }

  /// A restarted device no longer calibrates and has forgotten the commands. Once the score is known, nothing is
  /// lost.
  void on_any_frame(const protocols::Frame& frame) override {
    if (frame.id != tcm2::kBanner) return;
    if (!score_) fail("the compass has restarted");
    may_calibrate_ = false;
    start_part(Part::resuming, now_ns() + kSettle_ns);
  }

  /// Whether a frame answers what was asked, rather than something before it.
  bool is_reply(const protocols::Frame& frame) {
    const auto reply = frame.id == tcm2::kReply ? tcm2::decode_reply(frame.bytes) : std::nullopt;
    if (!reply) return false;
    if (reply->kind == tcm2::Reply::Kind::refused) {
      if (asked_ == "mpcal=e") may_calibrate_ = false;
      fail(fmt::format("{} refused (E{:03X})", asked_, reply->error));
      return true;
    }
    const bool is_score = reply->kind == tcm2::Reply::Kind::calibration;
    if (reply->kind == tcm2::Reply::Kind::value &&
        reply->parameter != tcm2::name_of(Parameter::multipoint_calibration))
      return false;
    if (part_ != Part::closing) return asked_ == "cc" || !is_score;
    if (asked_ == "lc?" && !is_score) return false;
    may_calibrate_ = false;
    if (is_score && failure().empty()) score_ = reply->score;
    return true;
  }

  bool count_word(const protocols::Frame& frame) {
    if (frame.id == tcm2::kReply || frame.id == tcm2::kBanner) return false;
    const auto word = frame.id == tcm2::kWord ? tcm2::decode_word(frame.bytes) : std::nullopt;
    if (word && word->heading) by_compass_.add(radians_of(*word->heading, heading_unit_));
    return true;
  }
  /// The gyro is preferred: the compass is calibrated because its headings are wrong.
  [[nodiscard]] double turned_rad() const { return gyro_ns_ ? by_gyro_.turned_rad() : by_compass_.turned_rad(); }

  void forget_results() override {
    score_.reset();
    by_compass_ = by_gyro_ = {};
    gyro_ns_.reset();
    gyro_angle_rad_ = 0;
  }
  [[nodiscard]] std::string called_off() const override { return turning_ ? "" : "called off"; }
  [[nodiscard]] std::string progress() const override {
    return fmt::format("turned {:.0f} of {:.0f} degrees", turned_rad() * base::kDegreesPerRadian,
                       kTurns_rad * base::kDegreesPerRadian);
  }
  [[nodiscard]] std::string result() const override {
    tcm2::Reply reply;
    reply.kind = tcm2::Reply::Kind::calibration;
    reply.score = *score_;
    const auto bytes = tcm2::encode_reply(reply);
    return "score " + std::string(bytes.begin(), bytes.end() - 2);  // without CR LF
  }
  static std::vector<std::uint8_t> multipoint(char letter) {
    return tcm2::encode_command(tcm2::set(Parameter::multipoint_calibration, letter));
  }

  config::AngleUnit heading_unit_;
  std::int64_t longest_ns_;
  std::int64_t stopped_after_ns_;  ///< words are taken to have stopped after this time without one
  const Answers replies_ = [this](const protocols::Frame& frame) { return is_reply(frame); };
  std::string_view asked_;
  TurnCount by_compass_, by_gyro_;
  double gyro_angle_rad_ = 0;
  std::optional<std::int64_t> gyro_ns_;  ///< of the newest rate
  std::optional<tcm2::CalibrationScore> score_;
};

}  // namespace

std::unique_ptr<CompassCalibration> calibrate_tcm2(const config::PortSettings& settings, std::int64_t longest_ns) {
  return std::make_unique<Tcm2Calibration>(settings, longest_ns);
}

}  // namespace navcal::instruments
