// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/reference_instruments.h"
#include "calib/archive.h"
#include "calib/delay/delay.h"
#include "calib/gps/gps_track.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Model: chi - psi_m = -f(psi_m)'beta + (k - tau) r + noise (rad), chi the GPS course of velocity noise
/// sigma_v / V, f'beta deviation and, to first order, current, r the turn rate (rad/s), k the slip coefficient (s,
/// THESIS section 9). Slip and delay are both in proportion to the turn rate: what is seen is their difference
/// alone, and the delay is known no better than the slip; the standard error says so. Recursive least squares.
class CourseDelay {
 public:
  struct Parameters {
    double velocity_std_m_s = base::reference::kVelocityNoise_m_s;
    double course_floor_rad = 0.01;  ///< noise of a course however fast
    double slip_s = -0.15, slip_std_s = 0.1;
    double deviation_std_rad = 0.5;
    double delay_std_s = 3;
    double least_speed_m_s = 0.4;
  };

  CourseDelay() : CourseDelay(Parameters{}) {}
  explicit CourseDelay(const Parameters& parameters);

  void update(const WaterTrackReading& track);
  void update(const GroundReading& ground);

  [[nodiscard]] Delay estimate() const;
  /// tau - k, which is what the data tell.
  [[nodiscard]] Delay less_slip() const;
  void archive(Archive& archive);

 private:
  using Vector = Eigen::Matrix<double, 6, 1>;
  using Matrix = Eigen::Matrix<double, 6, 6>;
  void correct(const GroundReading& ground, const WaterTrackReading& at);

  Parameters parameters_;
  GpsTrack track_;
  Vector state_ = Vector::Zero();  ///< A..E, tau - k
  Matrix covariance_;
  double chi_squared_ = 0;  ///< sum of the squared innovations over their variances
  double rate_sum_ = 0, rate_square_sum_ = 0;
  std::uint64_t readings_ = 0;
};

}  // namespace navcal::calib
