// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/durations.h"
#include "instruments/dialogue.h"

namespace navcal::instruments {

/// A compass's calibration of itself: a dialogue in which the device takes samples while the vehicle turns, and
/// then answers a score. StartUp must be silent meanwhile. In every case it leaves the device in service.
class CompassCalibration : public Dialogue {
 public:
  /// One number of the score.
  struct Figure {
    std::string_view name;
    double value = 0;
  };

  /// In control commands and reports: "tcm2", "pni".
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// What the operator does meanwhile: "turn twice, slowly, with as much tilt as possible".
  [[nodiscard]] virtual std::string_view manoeuvre() const = 0;

  /// Begins a calibration; the device must be in service. The results of an earlier one are forgotten.
  void begin(std::int64_t now_ns);
  /// Ends the turning on the operator's request. Before the turning has begun, it calls the calibration off.
  void stop(std::int64_t now_ns);
  /// Ends at once, because the device cannot be reached any more.
  void abandon(std::string reason);
  /// Lets the device keep its result beyond a loss of power. Returns why it cannot; empty: it was begun.
  virtual std::string save(std::int64_t now_ns) = 0;
  /// Calibrated yaw rate of a gyro.
  virtual void on_yaw_rate(double /*rate_rad_s*/, std::int64_t /*now_ns*/) {}

  [[nodiscard]] bool busy() const { return under_way(); }
  /// Score of the current or last calibration; empty until the compass has answered it.
  [[nodiscard]] virtual std::vector<Figure> figures() const = 0;
  /// Whether the compass may correct itself differently than before, whatever the result.
  [[nodiscard]] bool touched() const { return touched_; }
  /// Reason why there is no score; empty during a calibration and after success.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// State as text for people: "turned 310 of 720 degrees", "5 of 12 samples", "failed: cc refused (E010)".
  [[nodiscard]] std::string state() const;

 protected:
  /// What a script does; a part goes on with the next, but for the last two.
  enum class Part : std::uint8_t { calibrating, closing, resuming, saving };

  virtual void forget_results() = 0;
  /// Why the operator's stop ends it without a score; empty: there is one.
  [[nodiscard]] virtual std::string called_off() const = 0;
  [[nodiscard]] virtual std::string progress() const = 0;
  /// The score in words.
  [[nodiscard]] virtual std::string result() const = 0;

  void start_part(Part part, std::int64_t when_ns);
  /// The first reason counts.
  void fail(std::string reason);
  /// What follows a failure, or the end of the turning.
  [[nodiscard]] Part after_turning() const { return may_calibrate_ ? Part::closing : Part::resuming; }

  Part part_ = Part::calibrating;
  bool turning_ = false, touched_ = false;
  bool may_calibrate_ = false;  ///< the device was told to, and may have obeyed
  std::string doing_;           ///< for people

 private:
  std::string failure_;
};

/// nullptr for a device without such a calibration. `longest_ns` is the time for the turning.
[[nodiscard]] std::unique_ptr<CompassCalibration> make_compass_calibration(
    const config::PortSettings& settings, std::int64_t longest_ns = 600 * base::kSecond_ns);
/// Whether a compass can have this name in control commands.
[[nodiscard]] bool is_compass_calibration(std::string_view name);

/// What make_compass_calibration() chooses from.
[[nodiscard]] std::unique_ptr<CompassCalibration> calibrate_pni(std::int64_t longest_ns);
[[nodiscard]] std::unique_ptr<CompassCalibration> calibrate_tcm2(const config::PortSettings& settings,
                                                                 std::int64_t longest_ns);

}  // namespace navcal::instruments
