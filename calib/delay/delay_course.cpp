// SPDX-License-Identifier: Apache-2.0
#include "calib/delay/delay_course.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/square.h"

namespace navcal::calib {
namespace {

constexpr int kLessSlip = 5;

}  // namespace

CourseDelay::CourseDelay(const Parameters& parameters) : parameters_(parameters) {
  Vector std = Vector::Constant(parameters.deviation_std_rad);
  std[kLessSlip] = parameters.delay_std_s;
  covariance_ = std.array().square().matrix().asDiagonal();
}

void CourseDelay::update(const WaterTrackReading& track) {
  track_.update(
      track, [](const auto&, const auto&) {},
      [this](const GroundReading& ground, const WaterTrackReading& at) { correct(ground, at); }, [] {});
}

void CourseDelay::update(const GroundReading& ground) { track_.update(ground); }

void CourseDelay::correct(const GroundReading& ground, const WaterTrackReading& at) {
  if (!ground.course_rad || !std::isfinite(*ground.course_rad + ground.speed_m_s)) return;
  if (ground.speed_m_s < parameters_.least_speed_m_s) return;
  const double psi = at.heading_rad;
  Vector row;
  row << 1, std::sin(psi), std::cos(psi), std::sin(2 * psi), std::cos(2 * psi), at.turn_rate_rad_s;
  const Vector response = covariance_ * row;
  const double variance = row.dot(response) + base::square(parameters_.course_floor_rad) +
                          base::square(parameters_.velocity_std_m_s / ground.speed_m_s);
  const double innovation = std::remainder(psi - *ground.course_rad - row.dot(state_), 2 * std::numbers::pi);
  state_ += response * (innovation / variance);
  covariance_ -= response * response.transpose() / variance;
  chi_squared_ += base::square(innovation) / variance;
  rate_sum_ += at.turn_rate_rad_s;
  rate_square_sum_ += base::square(at.turn_rate_rad_s);
  ++readings_;
}

Delay CourseDelay::less_slip() const {
  if (readings_ == 0) return {};
  const auto n = static_cast<double>(readings_);
  return {.delay_s = state_[kLessSlip],
          .std_s = std::sqrt(covariance_(kLessSlip, kLessSlip) * std::max(1.0, chi_squared_ / n)),
          .readings = readings_,
          .rate_spread_rad_s = std::sqrt(std::max(0.0, rate_square_sum_ / n - base::square(rate_sum_ / n)))};
}

Delay CourseDelay::estimate() const {
  Delay delay = less_slip();
  delay.delay_s += parameters_.slip_s;
  delay.std_s = std::hypot(delay.std_s, parameters_.slip_std_s);
  return delay;
}

void CourseDelay::archive(Archive& archive) {
  archive.tag("course_delay 1");
  archive(track_, state_, covariance_, chi_squared_, rate_sum_, rate_square_sum_, readings_);
}

}  // namespace navcal::calib
