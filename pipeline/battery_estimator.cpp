// SPDX-License-Identifier: Apache-2.0
#include "pipeline/battery_estimator.h"

#include <algorithm>
#include <cmath>

namespace navcal::pipeline {
namespace {

constexpr double kSecondsPerHour = 3600;
/// A value older than this is no longer current.
constexpr std::int64_t kCurrent_ns = 3'000'000'000;
/// Between two corrections by the voltage.
constexpr std::int64_t kCorrection_ns = 10'000'000'000;
/// White noise of a voltage that is averaged over that time, one standard deviation.
constexpr double kVoltageNoise_V = 0.03;
/// The error of the curve at one charge says little of that at another, so large a share of the capacity away.
constexpr double kCurveShare = 0.3;
/// An unseen load empties the battery in this time, if no mean load says more.
constexpr double kUnseen_h = 4;
/// Below this mean load no time is given.
constexpr double kLeastLoad_A = 0.01;

enum Index { kCharge, kCurrentError, kHotelError, kCurveError };

struct CurvePoint {
  double voltage_V = 0;
  double slope_V = 0;  ///< over the share of the capacity
};

/// The curve at `share` of the capacity, straight between its points and beyond its ends.
CurvePoint curve_at(const std::array<double, 8>& curve_V, double share) {
  constexpr double kSteps = 7;
  const double place = std::clamp(share, 0.0, 1.0) * kSteps;
  const auto below = std::min<std::size_t>(static_cast<std::size_t>(place), curve_V.size() - 2);
  const double slope_V = (curve_V[below + 1] - curve_V[below]) * kSteps;
  return {curve_V[below] + slope_V * (share - static_cast<double>(below) / kSteps), slope_V};
}

}  // namespace

BatteryEstimator::BatteryEstimator(const config::BatterySettings& settings) : settings_(settings) {
  // Unknown: all charges from none to full are alike.
  state_[kCharge] = settings.capacity_Ah / 2;
  covariance_.diagonal() << std::pow(settings.capacity_Ah, 2) / 12, std::pow(settings.current_error, 2),
      std::pow(settings.hotel_error_A, 2), std::pow(settings.voltage_error_V, 2);
}

void BatteryEstimator::set(const BatteryCharge& charge) {
  if (!std::isfinite(charge.charge_Ah) || !std::isfinite(charge.std_Ah)) return;
  state_[kCharge] = std::clamp(charge.charge_Ah, 0.0, settings_.capacity_Ah);
  covariance_.row(kCharge).setZero();
  covariance_.col(kCharge).setZero();
  covariance_(kCharge, kCharge) = std::pow(std::clamp(charge.std_Ah, 0.0, settings_.capacity_Ah), 2);
  known_ = true;
}

void BatteryEstimator::motor_current(std::int64_t time_ns, double current_A) {
  if (!std::isfinite(current_A)) return;
  advance(time_ns);
  motor_A_ = current_A;
  motor_ns_ = time_ns_;
}

void BatteryEstimator::gauge(std::int64_t time_ns, const std::optional<double>& current_A,
                             const std::optional<double>& voltage_V) {
  advance(time_ns);
  if (current_A && std::isfinite(*current_A)) {
    gauge_A_ = *current_A;
    gauge_ns_ = time_ns_;
  }
  if (!voltage_V || !std::isfinite(*voltage_V)) return;
  voltage_V_ = voltage_V;
  voltage_ns_ = time_ns_;
  if (has_rested() && (!corrected_ns_ || *time_ns_ - *corrected_ns_ >= kCorrection_ns)) {
    corrected_ns_ = time_ns_;
    correct(*voltage_V + settings_.resistance_ohm * this->current_A().value_or(0));
  }
}

void BatteryEstimator::speed(std::int64_t time_ns, double speed_m_s) {
  if (!std::isfinite(speed_m_s)) return;
  advance(time_ns);
  const double size_m_s = std::abs(speed_m_s);
  if (!mean_speed_m_s_ || !speed_ns_) {
    mean_speed_m_s_ = size_m_s;
  } else {
    const double duration_s = static_cast<double>(*time_ns_ - *speed_ns_) * 1e-9;
    *mean_speed_m_s_ += (1 - std::exp(-duration_s / settings_.mean_s)) * (size_m_s - *mean_speed_m_s_);
  }
  speed_ns_ = time_ns_;
}

void BatteryEstimator::advance(std::int64_t time_ns) {
  if (!time_ns_) time_ns_ = time_ns;
  if (time_ns <= *time_ns_) return;
  const double duration_s = static_cast<double>(time_ns - *time_ns_) * 1e-9;
  time_ns_ = time_ns;
  const auto load_A = current_A();
  load_A ? count(duration_s, *load_A) : count_unseen(duration_s);
  hold_in_bounds();
  if (!load_A || std::abs(*load_A) > settings_.rest_A) {
    rest_since_ns_.reset();
  } else if (!rest_since_ns_) {
    rest_since_ns_ = time_ns_;
  }
}

void BatteryEstimator::count(double duration_s, double load_A) {
  const bool hotel = !measures_all();
  const double hours = duration_s / kSecondsPerHour;
  const double taken_Ah = load_A * hours;
  Matrix transition = Matrix::Identity();
  transition(kCharge, kCurrentError) = -(hotel ? motor_A_ : gauge_A_) * hours;
  transition(kCharge, kHotelError) = hotel ? -hours : 0;
  state_ = (transition * state_).eval();
  state_[kCharge] -= taken_Ah;
  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  wander(taken_Ah);
  const double share = mean_load_A_ ? 1 - std::exp(-duration_s / settings_.mean_s) : 1;
  mean_load_A_ = mean_load_A_.value_or(0) + share * (load_A - mean_load_A_.value_or(0));
}

void BatteryEstimator::count_unseen(double duration_s) {
  const double hours = duration_s / kSecondsPerHour;
  const double load_A = mean_load_A_.value_or(settings_.hotel_A);
  state_[kCharge] -= load_A * hours;
  // The error of an unseen load is constant too: the standard deviation grows by it, not the variance.
  const double std_Ah = std::sqrt(covariance_(kCharge, kCharge));
  const double grown_Ah = std_Ah + std::max(load_A, settings_.capacity_Ah / kUnseen_h) * hours;
  covariance_(kCharge, kCharge) = grown_Ah * grown_Ah;
  wander(load_A * hours);
}

/// The error of the curve forgets while charge is taken.
void BatteryEstimator::wander(double taken_Ah) {
  const double kept = std::exp(-std::abs(taken_Ah) / (kCurveShare * settings_.capacity_Ah));
  state_[kCurveError] *= kept;
  covariance_.row(kCurveError) *= kept;
  covariance_.col(kCurveError) *= kept;
  covariance_(kCurveError, kCurveError) += (1 - kept * kept) * std::pow(settings_.voltage_error_V, 2);
}

bool BatteryEstimator::has_rested() const {
  const bool has_curve = settings_.curve_V.back() > settings_.curve_V.front();
  return has_curve && rest_since_ns_ &&
         static_cast<double>(*time_ns_ - *rest_since_ns_) * 1e-9 >= settings_.rest_s;
}

void BatteryEstimator::correct(double open_circuit_V) {
  constexpr int kIterations = 8;
  const Vector before = state_;
  Vector gain = Vector::Zero();
  Eigen::RowVector4d jacobian = Eigen::RowVector4d::Zero();
  for (int i = 0; i < kIterations; ++i) {
    const CurvePoint point = curve_at(settings_.curve_V, state_[kCharge] / settings_.capacity_Ah);
    jacobian[kCharge] = point.slope_V / settings_.capacity_Ah;
    jacobian[kCurveError] = 1;
    const double variance_V2 = jacobian * covariance_ * jacobian.transpose() + kVoltageNoise_V * kVoltageNoise_V;
    gain = covariance_ * jacobian.transpose() / variance_V2;
    const double innovation_V =
        open_circuit_V - point.voltage_V - state_[kCurveError] - jacobian * (before - state_);
    state_ = before + gain * innovation_V;
    hold_in_bounds();
  }
  const Matrix rest = Matrix::Identity() - gain * jacobian;
  covariance_ =
      (rest * covariance_ * rest.transpose() + kVoltageNoise_V * kVoltageNoise_V * gain * gain.transpose()).eval();
  known_ = true;
}

void BatteryEstimator::hold_in_bounds() {
  state_[kCharge] = std::clamp(state_[kCharge], 0.0, settings_.capacity_Ah);
}

bool BatteryEstimator::is_current(const Time& time_ns) const {
  return time_ns && time_ns_ && *time_ns_ - *time_ns <= kCurrent_ns;
}

std::optional<BatteryCharge> BatteryEstimator::charge() const {
  if (!known_) return std::nullopt;
  return BatteryCharge{state_[kCharge], std::min(std::sqrt(covariance_(kCharge, kCharge)), settings_.capacity_Ah)};
}

std::optional<double> BatteryEstimator::current_A() const {
  if (measures_all()) return gauge_A_;
  if (is_current(motor_ns_)) return motor_A_ + settings_.hotel_A;
  return std::nullopt;
}

std::optional<double> BatteryEstimator::voltage_V() const {
  return is_current(voltage_ns_) ? voltage_V_ : std::nullopt;
}

std::optional<double> BatteryEstimator::time_left_s() const {
  if (!known_ || !mean_load_A_ || *mean_load_A_ < kLeastLoad_A) return std::nullopt;
  return state_[kCharge] / *mean_load_A_ * kSecondsPerHour;
}

std::optional<double> BatteryEstimator::range_left_m() const {
  const auto left_s = time_left_s();
  if (!left_s || !mean_speed_m_s_) return std::nullopt;
  return *left_s * *mean_speed_m_s_;
}

}  // namespace navcal::pipeline
