// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Model: two gyros on one axis, each calibrated as true rate = scale * measured + bias, differ by a constant
/// (what their calibrations left) and by white noise, rad/s. The constant is the mean of the difference over a
/// window whose weights fade by time; its standard error comes from the scatter of the difference itself, so no
/// noise need be known, and is what one gyro against the other can tell without any compass.
class GyroPair {
 public:
  struct Parameters {
    double window_s = 30;
    double longest_gap_s = 1;  ///< a longer one begins a new window
  };
  struct Line {
    double scale = 1;
    double bias_rad_s = 0;
  };

  explicit GyroPair(const Parameters& parameters) : parameters_(parameters) {}

  /// A change of either begins a new window.
  void set_calibration(const Line& a, const Line& b);
  /// Left out without gyro B, when not finite, saturated or not later than the one before.
  void update(const RateReading& reading);

  /// Gyro A less gyro B; nothing before kEnough readings.
  [[nodiscard]] std::optional<double> disagreement_rad_s() const;
  /// Whether both gyros have said something since the calibration last changed.
  [[nodiscard]] bool has_readings() const { return readings_ > 0; }
  /// Standard error of the disagreement by scatter alone. The errors of the calibrations are not included.
  [[nodiscard]] double standard_error_rad_s() const;
  void archive(Archive& archive);

 private:
  static constexpr std::uint64_t kEnough = 20;
  void begin_window();

  Parameters parameters_;
  Line a_, b_;
  double last_s_ = 0;
  double weight_ = 0, square_weight_ = 0;  ///< sums of the weights and of their squares
  double mean_rad_s_ = 0;
  double scatter_rad2_s2_ = 0;  ///< weighted sum of squares about the mean
  std::uint64_t readings_ = 0;
};

}  // namespace navcal::calib
