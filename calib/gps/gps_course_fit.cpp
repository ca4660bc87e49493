// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/gps_course_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/gps/gps_coefficients.h"

namespace navcal::calib {

GpsCourseFit::GpsCourseFit(const Parameters& parameters)
    : parameters_(parameters),
      covariance_(Matrix::Identity() * (parameters.deviation_std_rad * parameters.deviation_std_rad)) {}

void GpsCourseFit::update(const WaterTrackReading& track) {
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

void GpsCourseFit::update(const GroundReading& ground) { track_.update(ground); }

void GpsCourseFit::archive(Archive& archive) {
  archive.tag("gps_course_fit 1");
  archive(track_, estimate_, covariance_, fixes_);
}

}  // namespace navcal::calib
