// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "protocols/frame.h"

namespace navcal::instruments {

/// A compass's calibration of itself: a dialogue in which the device takes samples while the vehicle turns, and
/// then answers a score. A state machine like StartUp, which must be silent meanwhile. In every case it leaves the
/// device in service.
class CompassCalibration {
 public:
  /// One number of the score.
  struct Figure {
    std::string_view name;
    double value = 0;
  };

  virtual ~CompassCalibration() = default;
  /// In control commands and reports: "tcm2", "pni".
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// What the operator does meanwhile: "turn twice, slowly, with as much tilt as possible".
  [[nodiscard]] virtual std::string_view manoeuvre() const = 0;

  /// Begins a calibration; the device must be in service. The results of an earlier one are forgotten.
  virtual void begin(std::int64_t now_ns) = 0;
  /// Ends the turning on the operator's request. Before the turning has begun, it calls the calibration off.
  virtual void stop(std::int64_t now_ns) = 0;
  /// Ends at once, because the device cannot be reached any more.
  virtual void abandon(std::string reason) = 0;
  /// Lets the device keep its result beyond a loss of power. Returns why it cannot; empty: it was begun.
  virtual std::string save(std::int64_t now_ns) = 0;

  virtual void on_frame(const protocols::Frame& frame, std::int64_t now_ns) = 0;
  /// Calibrated yaw rate of a gyro.
  virtual void on_yaw_rate(double rate_rad_s, std::int64_t now_ns) = 0;
  /// Bytes to send now, if any; call again until nullopt.
  virtual std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) = 0;
  /// Time at which next() should be called again, monotonic; INT64_MAX when only a frame can change something.
  [[nodiscard]] virtual std::int64_t deadline_ns() const = 0;

  [[nodiscard]] virtual bool busy() const = 0;
  /// Score of the current or last calibration; empty until the compass has answered it.
  [[nodiscard]] virtual std::vector<Figure> figures() const = 0;
  /// Whether the compass may correct itself differently than before, whatever the result.
  [[nodiscard]] virtual bool touched() const = 0;
  /// Reason why there is no score; empty during a calibration and after success.
  [[nodiscard]] virtual const std::string& failure() const = 0;
  /// State as text for people: "turned 310 of 720 degrees", "5 of 12 samples", "failed: cc refused (E010)".
  [[nodiscard]] virtual std::string state() const = 0;
};

/// nullptr for a device without such a calibration.
[[nodiscard]] std::unique_ptr<CompassCalibration> make_compass_calibration(const config::PortSettings& settings);
/// Whether a compass can have this name in control commands.
[[nodiscard]] bool is_compass_calibration(std::string_view name);

}  // namespace navcal::instruments
