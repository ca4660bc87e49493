// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "instruments/compass_calibration.h"
#include "instruments/turn_count.h"
#include "protocols/tcm2_reply.h"

namespace navcal::instruments {

/// The TCM2's own calibration (ICD section 1): `h` twice, `cc`, `mpcal=e`, `go`. The vehicle then makes two
/// slow turns with as much tilt as possible. At the end: `h` twice, `mpcal=d`, which answers the score
/// (otherwise `lc?` does), `go`.
class Tcm2Calibration final : public CompassCalibration {
 public:
  static constexpr std::string_view kName = "tcm2";

  struct Limits {
    double turns = 2;
    std::int64_t longest_ns = 600'000'000'000;  ///< the score is read after this time, turned or not
  };
  explicit Tcm2Calibration(const config::PortSettings& settings) : Tcm2Calibration(settings, Limits{}) {}
  Tcm2Calibration(const config::PortSettings& settings, const Limits& limits);

  [[nodiscard]] std::string_view name() const override { return kName; }
  [[nodiscard]] std::string_view manoeuvre() const override {
    return "turn twice, slowly, with as much tilt as possible";
  }
  void begin(std::int64_t now_ns) override;
  void stop(std::int64_t now_ns) override;
  void abandon(std::string reason) override;
  std::string save(std::int64_t) override {
    return "the TCM2 applies its calibration itself: there is nothing to accept or to roll back";
  }
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  /// Without a gyro, the compass that is being calibrated counts the turns.
  void on_yaw_rate(double rate_rad_s, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] std::int64_t deadline_ns() const override { return due_ns_; }

  [[nodiscard]] bool busy() const override { return phase_ != Phase::idle; }
  /// Score of the current or last calibration, once the compass has answered it.
  [[nodiscard]] const std::optional<protocols::tcm2::CalibrationScore>& score() const { return score_; }
  [[nodiscard]] std::vector<Figure> figures() const override;
  /// Whether `cc` was sent.
  [[nodiscard]] bool touched() const override { return touched_; }
  [[nodiscard]] const std::string& failure() const override { return failure_; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,
    first_halt,   ///< the first `h` is due
    second_halt,  ///< the second `h` is due
    clearing,     ///< `cc` is to be sent or waits for its reply, as the following
    enabling,     ///< `mpcal=e`
    starting,     ///< `go`, until the first word
    turning,
    closing,   ///< `mpcal=d`
    asking,    ///< `lc?`
    resuming,  ///< `go`, until the first word
  };

  void enter(Phase phase, std::int64_t due_ns);
  void halt_then(Phase phase, std::int64_t now_ns);
  void end_turning(std::int64_t now_ns);
  void fail(std::string reason, std::int64_t now_ns);
  void on_reply(const protocols::tcm2::Reply& reply, std::int64_t now_ns);
  void on_word(const protocols::Frame& frame, std::int64_t now_ns);
  void on_unanswered(std::int64_t now_ns);
  [[nodiscard]] double turned_rad() const;

  config::AngleUnit heading_unit_;
  Limits limits_;
  std::int64_t stopped_after_ns_;  ///< words are taken to have stopped after this time without one
  Phase phase_ = Phase::idle;
  Phase after_halts_ = Phase::clearing;
  std::int64_t due_ns_ = std::numeric_limits<std::int64_t>::max();
  int attempts_ = 0;
  bool touched_ = false;
  bool calibrating_ = false;  ///< `mpcal=e` was sent and may have been obeyed
  std::int64_t turning_ends_ns_ = 0;
  TurnCount by_compass_, by_gyro_;
  double gyro_angle_rad_ = 0;
  std::optional<std::int64_t> gyro_ns_;  ///< of the newest rate
  std::optional<protocols::tcm2::CalibrationScore> score_;
  std::string failure_;
};

}  // namespace navcal::instruments
