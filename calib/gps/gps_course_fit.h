// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/reference_instruments.h"
#include "calib/archive.h"
#include "calib/gps/gps_track.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Model: wrap(psi_m + d - chi) = A + B sin psi_m + C cos psi_m + D sin 2 psi_m + E cos 2 psi_m (rad), chi the
/// course over ground: the course-error form (i) of THESIS section 9, linear, by recursive least squares. For
/// comparison: slip and current, which it ignores, are larger than what it seeks (THESIS 8); see GpsCompass.
class GpsCourseFit {
 public:
  using Vector = Eigen::Matrix<double, 5, 1>;
  using Matrix = Eigen::Matrix<double, 5, 5>;
  struct Parameters {
    double velocity_std_m_s = base::reference::kVelocityNoise_m_s;  ///< of the receiver, each axis
    double declination_rad = 0;                                     ///< d
    double deviation_std_rad = 1;                                   ///< prior of each coefficient
    double least_speed_m_s = 0.3;
  };

  GpsCourseFit() : GpsCourseFit(Parameters{}) {}
  explicit GpsCourseFit(const Parameters& parameters);

  void update(const WaterTrackReading& track);
  void update(const GroundReading& ground);

  [[nodiscard]] const Vector& estimate() const { return estimate_; }      ///< A..E, rad
  [[nodiscard]] const Matrix& covariance() const { return covariance_; }  ///< if there were no slip and no current
  [[nodiscard]] std::uint64_t fixes() const { return fixes_; }
  void archive(Archive& archive);

 private:
  Parameters parameters_;
  GpsTrack track_;
  Vector estimate_ = Vector::Zero();
  Matrix covariance_;
  std::uint64_t fixes_ = 0;
};

}  // namespace navcal::calib
