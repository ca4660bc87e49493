// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/reference_instruments.h"
#include "calib/gps/gps_coefficients.h"
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

 private:
  Parameters parameters_;
  GpsTrack track_;
  Vector estimate_ = Vector::Zero();
  Matrix covariance_;
  std::uint64_t fixes_ = 0;
};

inline GpsCourseFit::GpsCourseFit(const Parameters& parameters)
    : parameters_(parameters),
      covariance_(Matrix::Identity() * (parameters.deviation_std_rad * parameters.deviation_std_rad)) {}

inline void GpsCourseFit::update(const WaterTrackReading& track) {
  const auto fix = [this](const GroundReading& ground, const WaterTrackReading& at) {
    if (!ground.course_rad || !std::isfinite(*ground.course_rad) || !std::isfinite(ground.speed_m_s)) return;
    if (ground.speed_m_s < parameters_.least_speed_m_s) return;
    const double psi = at.heading_rad;
    const Vector f = deviation_harmonics(psi);
    // Wrapped about what is believed, so that no deviation lies beyond the seam.
    const double error = std::remainder(psi + parameters_.declination_rad - *ground.course_rad - f.dot(estimate_),
                                        2 * std::numbers::pi);
    const double std_rad = parameters_.velocity_std_m_s / ground.speed_m_s;
    const Vector response = covariance_ * f;
    const double variance = f.dot(response) + std_rad * std_rad;
    estimate_ += response * (error / variance);
    covariance_ -= response * response.transpose() / variance;
    ++fixes_;
  };
  track_.update(
      track, [](const auto&, const auto&) {}, fix, [] {});
}

inline void GpsCourseFit::update(const GroundReading& ground) { track_.update(ground); }

}  // namespace navcal::calib
