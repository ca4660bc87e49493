// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace navcal::nav {

struct AltitudeOptions {
  double noise_m = 0.1;             ///< of one reading, one standard deviation
  double range_m = 100;             ///< readings beyond it are left out
  double acceleration_m_s2 = 0.15;  ///< of the altitude: the vehicle's and the slope's, one standard deviation
  double tilt_error_rad = 0.02;     ///< one standard deviation
};

struct Altitude {
  double altitude_m = 0;  ///< straight down to the floor
  double std_m = 0;
  double rate_m_s = 0;  ///< positive: the floor falls away
  double rate_std_m_s = 0;
};

/// Height above the sea floor from slant ranges: a Kalman filter with constant rate and white acceleration.
///
/// The transducer looks along the body's z axis and the floor about it is level: altitude = range cos(pitch)
/// cos(roll). The error of the tilt is the same for many readings: it is added to the standard deviation of the
/// filter, not averaged. A reading more than five standard deviations off is left out (a fish, a double echo);
/// three of them in a row, or a pause of two seconds, begin the filter anew. Times never decrease; a reading that
/// is not newer than the last one is left out. No memory is taken, and no clock read.
class AltitudeFilter {
 public:
  explicit AltitudeFilter(const AltitudeOptions& options) : options_(options) {}

  [[nodiscard]] const AltitudeOptions& options() const { return options_; }
  /// Returns false when the reading is left out.
  bool take(std::int64_t time_ns, double range_m, double pitch_rad, double roll_rad);
  /// The altitude at that time; nullopt before the first reading, and two seconds after the last one.
  [[nodiscard]] std::optional<Altitude> at(std::int64_t time_ns) const;

 private:
  struct State {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  };
  [[nodiscard]] State predicted(double duration_s) const;
  void begin(double altitude_m, double variance_m2);

  AltitudeOptions options_;
  std::optional<std::int64_t> time_ns_;  ///< of the newest reading that was used
  std::int64_t newest_ns_ = 0;           ///< of the newest reading
  State state_;
  double by_tilt_m_ = 0;  ///< error by the tilt's, of the newest reading; one standard deviation
  int outliers_ = 0;
};

}  // namespace navcal::nav
