// SPDX-License-Identifier: Apache-2.0
#include "calib/delay/delay_heading.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/square.h"

namespace navcal::calib {
namespace {

constexpr double kHeadingPrior_rad = 10;

}  // namespace

HeadingDelay::HeadingDelay(const Parameters& parameters) : parameters_(parameters) {
  Vector std;
  std << kHeadingPrior_rad, parameters.scale_std, parameters.bias_std_rad_s, parameters.deviation_std_rad,
      parameters.deviation_std_rad, parameters.deviation_std_rad, parameters.deviation_std_rad,
      parameters.delay_std_s, parameters.tilt_lag_std_s;
  covariance_ = std.array().square().matrix().asDiagonal();
  state_[kScale] = 1;
}

void HeadingDelay::update(const TurnStep& step, const TiltSlope& tilt) {
  if (!std::isfinite(step.time_s + step.heading_rad + step.measured_angle_rad + step.bias_time_s +
                     step.tilt_angle_rad + step.duration_s + tilt.roll_rad_s + tilt.pitch_rad_s))
    return;
  // The rate about a reading is that of the steps before and after it.
  double angle_rad = 0, time_s = 0;
  if (!step.begins_segment) {
    if (step.duration_s <= 0) return;
    angle_rad = step.measured_angle_rad;
    time_s = step.bias_time_s;
  }
  if (waiting_) {
    const double about_s = waiting_->rate_time_s + time_s;
    if (about_s > 0) correct(waiting_->step, waiting_->tilt, (waiting_->rate_angle_rad + angle_rad) / about_s);
  }
  if (step.begins_segment) {
    begin(step);
  } else {
    predict(step);
  }
  waiting_ = Waiting{step, tilt, angle_rad, time_s};
}

void HeadingDelay::begin(const TurnStep& step) {
  covariance_.row(kPsi).setZero();
  covariance_.col(kPsi).setZero();
  covariance_(kPsi, kPsi) = base::square(kHeadingPrior_rad);
  state_[kPsi] = step.heading_rad;
}

void HeadingDelay::predict(const TurnStep& step) {
  state_[kPsi] +=
      state_[kScale] * step.measured_angle_rad + state_[kBias] * step.bias_time_s + step.tilt_angle_rad;
  const Vector row = covariance_.row(kPsi).transpose() +
                     step.measured_angle_rad * covariance_.row(kScale).transpose() +
                     step.bias_time_s * covariance_.row(kBias).transpose();
  covariance_.row(kPsi) = row.transpose();
  covariance_.col(kPsi) = row;
  covariance_(kPsi, kPsi) = row[kPsi] + step.measured_angle_rad * row[kScale] + step.bias_time_s * row[kBias] +
                            base::square(parameters_.rate_noise_rad_sqrt_s) * step.duration_s;
}

void HeadingDelay::correct(const TurnStep& step, const TiltSlope& tilt, double measured_rate_rad_s) {
  const double psi = step.heading_rad;
  const double sine = std::sin(psi), cosine = std::cos(psi);
  Vector row;
  row << 1, 0, 0, sine, cosine, std::sin(2 * psi), std::cos(2 * psi), -measured_rate_rad_s,
      tilt.pitch_rad_s * sine - tilt.roll_rad_s * cosine;
  const Vector response = covariance_ * row;
  const double variance = row.dot(response) + base::square(parameters_.heading_noise_rad);
  // The innovation is taken to the nearest whole turn because the state is not wrapped.
  const double innovation = std::remainder(psi - row.dot(state_), base::kTurn_rad);
  state_ += response * (innovation / variance);
  covariance_ -= response * response.transpose() / variance;
  chi_squared_ += base::square(innovation) / variance;
  blocks_.update(state_[kDelay], covariance_(kDelay, kDelay));
  rate_sum_ += measured_rate_rad_s;
  rate_square_sum_ += base::square(measured_rate_rad_s);
  ++readings_;
}

Delay HeadingDelay::estimate() const {
  if (readings_ == 0) return {};
  const auto n = static_cast<double>(readings_);
  // The regressor is the rate as measured, so the state is the delay times the gyro's scale.
  const double scale = state_[kScale];
  const double noise_s =
      std::sqrt(covariance_(kDelay, kDelay) * blocks_.variance_scale(std::max(1.0, chi_squared_ / n))) /
      std::abs(scale);
  return {.delay_s = state_[kDelay] / scale,
          .std_s = std::hypot(noise_s, parameters_.level_std_s),
          .readings = readings_,
          .rate_spread_rad_s = std::sqrt(std::max(0.0, rate_square_sum_ / n - base::square(rate_sum_ / n)))};
}

void HeadingDelay::archive(Archive& archive) {
  archive.tag("heading_delay 2");
  archive(state_, covariance_, waiting_, chi_squared_, blocks_, rate_sum_, rate_square_sum_, readings_);
}

void HeadingDelay::Waiting::archive(Archive& archive) {
  archive(step.time_s, step.heading_rad, step.begins_segment, step.duration_s, step.measured_angle_rad);
  archive(step.measured_angle_b_rad, step.bias_time_s, step.tilt_angle_rad);
  archive(tilt.roll_rad_s, tilt.pitch_rad_s, rate_angle_rad, rate_time_s);
}

}  // namespace navcal::calib
