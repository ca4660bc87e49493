// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/tilt_smoother.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/square.h"
#include "base/symmetric_solve.h"

namespace navcal::calib {
namespace {

/// Euler angles lose their meaning at 90 degrees.
constexpr double kSteepestTilt_rad = 1.4;
/// Standard deviation of the slope of the first readings.
constexpr double kSlopeStd_rad_s = 0.1;
/// Keeps the covariance regular where the fluid has settled; far below any inclinometer's resolution.
constexpr double kSettledVariance_rad2 = 1e-12;

}  // namespace

TiltSmoother::TiltSmoother(const Parameters& parameters) : parameters_(parameters) {
  covariance_(kBiasX, kBiasX) = covariance_(kBiasY, kBiasY) = base::square(parameters.bias_std_rad_s);
  covariance_(kScaleX, kScaleX) = covariance_(kScaleY, kScaleY) = base::square(parameters.scale_std);
}

void TiltSmoother::start(const Eigen::Vector2d& shown_rad, const Eigen::Vector2d& slope_rad_s) {
  count_ = 0;
  state_.segment<2>(kShownRoll) = shown_rad;
  state_.segment<2>(kRoll) = shown_rad + parameters_.lag_s * slope_rad_s;
  covariance_.topRows<4>().setZero();
  covariance_.leftCols<4>().setZero();
  const double shown_variance = base::square(parameters_.tilt_noise_rad);
  const double tilt_variance = shown_variance + base::square(kSlopeStd_rad_s * parameters_.lag_s);
  for (const int i : {kRoll, kPitch}) {
    covariance_(i, i) = tilt_variance;
    covariance_(i + 2, i + 2) = covariance_(i, i + 2) = covariance_(i + 2, i) = shown_variance;
  }
  node(0) = Node{state_, State::Zero(), Covariance::Zero()};
  since_ = covariance_;
  count_ = 1;
}

Eigen::Vector2d TiltSmoother::slope_rad_s(const State& state, const Eigen::Vector3d& rate_rad_s) {
  const double p = (1 + state[kScaleX]) * rate_rad_s.x() + state[kBiasX];
  const double q = (1 + state[kScaleY]) * rate_rad_s.y() + state[kBiasY];
  const double sin_roll = std::sin(state[kRoll]), cos_roll = std::cos(state[kRoll]);
  return {p + std::tan(state[kPitch]) * (q * sin_roll + rate_rad_s.z() * cos_roll),
          q * cos_roll - rate_rad_s.z() * sin_roll};
}

void TiltSmoother::predict(const Eigen::Vector3d& rate_rad_s, double duration_s) {
  const double q = (1 + state_[kScaleY]) * rate_rad_s.y() + state_[kBiasY], r = rate_rad_s.z();
  const double sin_roll = std::sin(state_[kRoll]), cos_roll = std::cos(state_[kRoll]);
  const double tan_pitch = std::tan(state_[kPitch]);
  const double across = q * sin_roll + r * cos_roll, along = q * cos_roll - r * sin_roll;

  // The slope in the middle, so that the step is of second order.
  const Eigen::Vector2d begin = state_.head<2>(), shown = state_.segment<2>(kShownRoll);
  state_.head<2>() += duration_s / 2 * slope_rad_s(state_, rate_rad_s);
  const Eigen::Vector2d slope = slope_rad_s(state_, rate_rad_s);
  const double kept = std::exp(-duration_s / parameters_.lag_s);
  state_.segment<2>(kShownRoll) =
      kept * shown + (1 - kept) * begin + (duration_s - parameters_.lag_s * (1 - kept)) * slope;
  state_.head<2>() = begin + duration_s * slope;
  for (const int i : {kRoll, kPitch}) state_[i] = std::clamp(state_[i], -kSteepestTilt_rad, kSteepestTilt_rad);

  Covariance transition = Covariance::Identity();
  Eigen::Matrix<double, 2, kStates> by_state;
  by_state.row(0) << tan_pitch * along, across * (1 + base::square(tan_pitch)), 0, 0, 1, tan_pitch * sin_roll,
      rate_rad_s.x(), tan_pitch * sin_roll * rate_rad_s.y();
  by_state.row(1) << -across, 0, 0, 0, 0, cos_roll, 0, cos_roll * rate_rad_s.y();
  transition.topRows<2>() += duration_s * by_state;
  for (const int i : {kRoll, kPitch}) {
    transition(i + 2, i + 2) = kept;
    transition(i + 2, i) = 1 - kept;
  }
  // Biases and scales stay: their rows are those of the identity.
  const auto moved = [&](const Covariance& from) {
    Covariance to = from;
    to.topRows<4>() = transition.topRows<4>().lazyProduct(from);
    return to;
  };
  since_ = moved(since_);
  covariance_ = moved(moved(covariance_).transpose()).transpose().eval();
  const double angle_variance = base::square(parameters_.rate_noise_rad_sqrt_s) * duration_s;
  covariance_(kRoll, kRoll) += angle_variance * (1 + base::square(tan_pitch));
  covariance_(kPitch, kPitch) += angle_variance;
  for (const int i : {kShownRoll, kShownPitch}) covariance_(i, i) += kSettledVariance_rad2;
  for (const int i : {kBiasX, kBiasY}) {
    covariance_(i, i) += base::square(parameters_.bias_walk_rad_s_sqrt_s) * duration_s;
  }
}

void TiltSmoother::correct(const Eigen::Vector2d& shown_rad) {
  node(count_ - 1).gain = base::solve_symmetric(covariance_, since_).transpose();
  const Eigen::Matrix<double, kStates, 2> with_shown = covariance_.middleCols<2>(kShownRoll);
  Eigen::Matrix2d variance = with_shown.middleRows<2>(kShownRoll);
  variance.diagonal().array() += base::square(parameters_.tilt_noise_rad);
  const Eigen::Matrix<double, kStates, 2> gain = with_shown * variance.inverse();
  const State change = gain * (shown_rad - state_.segment<2>(kShownRoll));
  state_ += change;
  covariance_ -= (gain * with_shown.transpose()).eval();
  covariance_ = ((covariance_ + covariance_.transpose()) / 2).eval();
  since_ = covariance_;
  node(count_) = Node{state_, change, Covariance::Zero()};
  ++count_;
}

TiltSmoother::State TiltSmoother::oldest() const {
  State later = State::Zero();
  for (std::uint32_t i = count_; i-- > 1;) later = (node(i).change + node(i).gain * later).eval();
  return node(0).filtered + node(0).gain * later;
}

void TiltSmoother::drop_oldest() {
  first_ = (first_ + 1) % kCapacity;
  --count_;
}

void TiltSmoother::archive(Archive& archive) {
  archive.tag("tilt_smoother 1");
  archive(state_, covariance_, since_, count_);
  if (!archive.saving()) first_ = 0;
  if (count_ > kCapacity) count_ = 0;  // damaged
  // Only nodes in use are archived, because the state is written to the log again and again.
  for (std::uint32_t i = 0; i < count_; ++i) archive(node(i));
}

}  // namespace navcal::calib
