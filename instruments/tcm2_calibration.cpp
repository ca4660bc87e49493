// SPDX-License-Identifier: Apache-2.0
#include "instruments/tcm2_calibration.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "base/angles.h"
#include "base/durations.h"
#include "instruments/tcm2_dialogue.h"
#include "instruments/units.h"
#include "protocols/decimal.h"
#include "protocols/tcm2.h"
#include "protocols/tcm2_commands.h"

namespace navcal::instruments {
namespace {

namespace tcm2 = protocols::tcm2;
using tcm2::Parameter;
using tcm2::Verb;

constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();
/// Longest gap between two gyro rates that is integrated over.
constexpr std::int64_t kLongestRateGap_ns = 500 * base::kMillisecond_ns;

tcm2::Command multipoint(char letter) { return tcm2::set(Parameter::multipoint_calibration, letter); }

std::string degrees(double angle_rad) { return std::to_string(std::lround(angle_rad / base::kRadiansPerDegree)); }

std::string text_of(const tcm2::CalibrationScore& score) {
  tcm2::Reply reply;
  reply.kind = tcm2::Reply::Kind::calibration;
  reply.score = score;
  const auto bytes = tcm2::encode_reply(reply);
  return {bytes.begin(), bytes.end() - 2};  // without CR LF
}

}  // namespace

Tcm2Calibration::Tcm2Calibration(const config::PortSettings& settings, const Limits& limits)
    : heading_unit_(settings.compass.heading_unit), limits_(limits), stopped_after_ns_(kTcm2Stopped_ns) {
  if (settings.rate_Hz > 0) {
    stopped_after_ns_ = std::max(kTcm2Stopped_ns, static_cast<std::int64_t>(3e9 / settings.rate_Hz));
  }
}

void Tcm2Calibration::begin(std::int64_t now_ns) {
  touched_ = calibrating_ = false;
  score_.reset();
  failure_.clear();
  by_compass_ = by_gyro_ = {};
  gyro_ns_.reset();
  gyro_angle_rad_ = 0;
  halt_then(Phase::clearing, now_ns);
}

void Tcm2Calibration::stop(std::int64_t now_ns) {
  switch (phase_) {
    case Phase::first_halt:
    case Phase::second_halt:
    case Phase::clearing:
    case Phase::enabling:
    case Phase::starting:
      if (after_halts_ == Phase::clearing) fail("called off", now_ns);
      break;
    case Phase::turning: end_turning(now_ns); break;
    case Phase::idle:
    case Phase::closing:
    case Phase::asking:
    case Phase::resuming: break;
  }
}

void Tcm2Calibration::abandon(std::string reason) {
  if (phase_ == Phase::idle) return;
  if (failure_.empty() && !score_) failure_ = std::move(reason);
  enter(Phase::idle, kNever_ns);
}

void Tcm2Calibration::enter(Phase phase, std::int64_t due_ns) {
  phase_ = phase;
  due_ns_ = due_ns;
  attempts_ = 0;
}

void Tcm2Calibration::halt_then(Phase phase, std::int64_t now_ns) {
  after_halts_ = phase;
  enter(Phase::first_halt, now_ns);
}

void Tcm2Calibration::end_turning(std::int64_t now_ns) { halt_then(Phase::closing, now_ns); }

void Tcm2Calibration::fail(std::string reason, std::int64_t now_ns) {
  if (failure_.empty()) failure_ = std::move(reason);
  if (calibrating_ && after_halts_ != Phase::closing) {
    halt_then(Phase::closing, now_ns);
  } else {
    enter(Phase::resuming, now_ns);
  }
}

void Tcm2Calibration::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (phase_ == Phase::idle) return;
  if (frame.id == tcm2::kBanner) {
    // A restarted device no longer calibrates and has forgotten the commands. Once the score is known, nothing
    // is lost.
    calibrating_ = false;
    if (!score_) fail("the compass has restarted", now_ns);
    if (phase_ != Phase::resuming) enter(Phase::resuming, now_ns);
    due_ns_ = now_ns + kSettle_ns;
  } else if (frame.id == tcm2::kReply) {
    if (const auto reply = tcm2::decode_reply(frame.bytes)) on_reply(*reply, now_ns);
  } else {
    on_word(frame, now_ns);
  }
}

void Tcm2Calibration::on_reply(const tcm2::Reply& reply, std::int64_t now_ns) {
  const bool awaited = attempts_ > 0 && (phase_ == Phase::clearing || phase_ == Phase::enabling ||
                                         phase_ == Phase::closing || phase_ == Phase::asking);
  if (!awaited) return;  // to a halt, to `go`, or late
  if (reply.kind == tcm2::Reply::Kind::refused) {
    std::string error;
    protocols::append_hex(error, reply.error, 3);
    const char* const what = phase_ == Phase::clearing   ? "cc"
                             : phase_ == Phase::enabling ? "mpcal=e"
                             : phase_ == Phase::closing  ? "mpcal=d"
                                                         : "lc?";
    if (phase_ == Phase::enabling) calibrating_ = false;
    return fail(std::string(what) + " refused (E" + error + ")", now_ns);
  }
  if (reply.kind == tcm2::Reply::Kind::value &&
      reply.parameter != tcm2::name_of(Parameter::multipoint_calibration)) {
    return;  // late, to a setting
  }
  const bool is_score = reply.kind == tcm2::Reply::Kind::calibration;
  switch (phase_) {
    case Phase::clearing: enter(Phase::enabling, now_ns); break;
    case Phase::enabling:
      if (!is_score) enter(Phase::starting, now_ns);
      break;
    case Phase::closing:
      calibrating_ = false;
      if (!failure_.empty()) return enter(Phase::resuming, now_ns);
      if (is_score) score_ = reply.score;
      enter(is_score ? Phase::resuming : Phase::asking, now_ns);
      break;
    case Phase::asking:
      if (!is_score) return;
      score_ = reply.score;
      enter(Phase::resuming, now_ns);
      break;
    default: break;
  }
}

void Tcm2Calibration::on_word(const protocols::Frame& frame, std::int64_t now_ns) {
  if (phase_ == Phase::resuming && attempts_ > 0) return enter(Phase::idle, kNever_ns);
  if (phase_ == Phase::starting && attempts_ > 0) {
    enter(Phase::turning, now_ns);
    turning_ends_ns_ = now_ns + limits_.longest_ns;
  }
  if (phase_ != Phase::turning) return;
  due_ns_ = std::min(now_ns + stopped_after_ns_, turning_ends_ns_);
  const auto word = frame.id == tcm2::kWord ? tcm2::decode_word(frame.bytes) : std::nullopt;
  if (word && word->heading) by_compass_.add(radians_of(*word->heading, heading_unit_));
  if (turned_rad() >= limits_.turns * 2 * std::numbers::pi) end_turning(now_ns);
}

void Tcm2Calibration::on_yaw_rate(double rate_rad_s, std::int64_t now_ns) {
  if (phase_ != Phase::turning) return;
  const std::int64_t since_ns = gyro_ns_ ? now_ns - *gyro_ns_ : 0;
  gyro_ns_ = now_ns;
  if (since_ns < kLongestRateGap_ns) gyro_angle_rad_ += rate_rad_s * static_cast<double>(since_ns) * 1e-9;
  by_gyro_.add(gyro_angle_rad_);
}

/// The gyro is preferred: the compass is calibrated because its headings are wrong.
double Tcm2Calibration::turned_rad() const { return gyro_ns_ ? by_gyro_.turned_rad() : by_compass_.turned_rad(); }

std::optional<std::vector<std::uint8_t>> Tcm2Calibration::next(std::int64_t now_ns) {
  if (now_ns < due_ns_) return std::nullopt;
  if (phase_ == Phase::turning) {
    if (now_ns >= turning_ends_ns_) {
      end_turning(now_ns);
    } else {
      fail("its words have stopped", now_ns);
    }
  }
  if (attempts_ >= kAttempts) on_unanswered(now_ns);
  const auto ask = [&](const tcm2::Command& command, std::int64_t patience_ns) {
    ++attempts_;
    due_ns_ = now_ns + patience_ns;
    return tcm2::encode_command(command);
  };
  switch (phase_) {
    case Phase::idle:
    case Phase::turning: return std::nullopt;
    case Phase::first_halt:
      enter(Phase::second_halt, now_ns + kBetweenHalts_ns);
      return tcm2::encode_command({Verb::halt});
    case Phase::second_halt: enter(after_halts_, now_ns + kSettle_ns); return tcm2::encode_command({Verb::halt});
    case Phase::clearing: touched_ = true; return ask({Verb::clear_calibration}, kReplyTimeout_ns);
    case Phase::enabling: calibrating_ = true; return ask(multipoint('e'), kReplyTimeout_ns);
    case Phase::closing: return ask(multipoint('d'), kReplyTimeout_ns);
    case Phase::asking: return ask({Verb::calibration_score}, kReplyTimeout_ns);
    case Phase::starting:
    case Phase::resuming: break;
  }
  return ask({Verb::go}, stopped_after_ns_);
}

void Tcm2Calibration::on_unanswered(std::int64_t now_ns) {
  switch (phase_) {
    case Phase::clearing: return fail("no answer to cc", now_ns);
    case Phase::enabling: return fail("no answer to mpcal=e", now_ns);
    case Phase::starting: return fail("no words came after go", now_ns);
    case Phase::closing:
      // The command may have been obeyed all the same: the score will show it.
      return enter(failure_.empty() ? Phase::asking : Phase::resuming, now_ns);
    case Phase::asking: return fail("no answer to lc?", now_ns);
    default: break;
  }
  // StartUp sees the silence and begins anew.
  if (failure_.empty()) failure_ = "no words came after it";
  enter(Phase::idle, kNever_ns);
}

std::vector<CompassCalibration::Figure> Tcm2Calibration::figures() const {
  if (!score_) return {};
  return {{"horizontal", static_cast<double>(score_->horizontal)},
          {"vertical", static_cast<double>(score_->vertical)},
          {"magnitude", score_->magnitude}};
}

std::string Tcm2Calibration::state() const {
  std::string text;
  switch (phase_) {
    case Phase::idle:
      if (!failure_.empty()) return "failed: " + failure_;
      return score_ ? "score " + text_of(*score_) : "not begun";
    case Phase::turning:
      return "turned " + degrees(turned_rad()) + " of " + degrees(limits_.turns * 2 * std::numbers::pi) +
             " degrees";
    case Phase::closing:
    case Phase::asking: text = "reading the score"; break;
    case Phase::resuming: text = "putting the compass back to service"; break;
    default: text = after_halts_ == Phase::closing ? "reading the score" : "preparing the compass"; break;
  }
  return failure_.empty() ? text : text + "; failed: " + failure_;
}

}  // namespace navcal::instruments
