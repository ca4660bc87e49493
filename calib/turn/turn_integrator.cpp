// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/turn_integrator.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "calib/correction.h"

namespace navcal::calib {
namespace {

/// Steeper than about 80 degrees roll and heading lose their meaning, and compasses give up.
constexpr double kSmallestCosine = 0.17;
/// The smoother looks no further ahead when so many readings of an instrument wait: their curves have little room.
constexpr std::uint32_t kCrowded = 100;
/// Marks the axis of a gyro that is not there; its angle is then no number either.
constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

TiltSmoother::Parameters tilt_parameters(const TurnIntegrator::Parameters& parameters) {
  TiltSmoother::Parameters tilt;
  tilt.lag_s = parameters.tilt_lag_s;
  tilt.tilt_noise_rad = parameters.tilt_noise_rad;
  tilt.rate_noise_rad_sqrt_s = parameters.rate_noise_rad_sqrt_s;
  return tilt;
}

}  // namespace

TurnIntegrator::TurnIntegrator(const Parameters& parameters)
    : parameters_(parameters), inclinometer_(parameters.tilt_lag_s, parameters.tilt_noise_rad),
      smoother_(tilt_parameters(parameters)) {}

template <class Curve>
bool TurnIntegrator::in_order(Curve& curve, double time_s) {
  if (curve.size() == 0) return true;
  const double since_s = time_s - curve.time_s(curve.size() - 1);
  if (std::abs(since_s) > parameters_.longest_gap_s) {
    end_segment();
    // Backwards it is another clock, on which nothing held here has a place.
    if (since_s < 0) begin_segment();
    curve.clear();
    return true;
  }
  return since_s > 0;
}

void TurnIntegrator::end_segment() {
  while (waiting_count_ < TiltSmoother::kCapacity) {
    const auto one = step(true);
    if (!one) break;
    waiting_[(first_waiting_ + waiting_count_) % TiltSmoother::kCapacity] = *one;
    ++waiting_count_;
  }
  given_out_s_.reset();
  smoother_.clear();
  inclinometer_.begin_segment();
  lag_tested_s_.reset();
}

void TurnIntegrator::update(const CompassReading& reading) {
  if (!std::isfinite(reading.time_s) || reading.faulty || !reading.heading_rad || !reading.roll_rad ||
      !reading.pitch_rad) {
    ++left_out_;
    return;
  }
  Eigen::Matrix<double, 6, 1> value;
  value << *reading.roll_rad, *reading.pitch_rad, *reading.heading_rad,
      reading.field_body_uT.value_or(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  if (!value.head<3>().allFinite() || std::cos(value[kRoll]) < kSmallestCosine ||
      std::cos(value[kPitch]) < kSmallestCosine || !in_order(compass_, reading.time_s)) {
    ++left_out_;
    return;
  }
  compass_.add(reading.time_s, value);
}

void TurnIntegrator::update(const RateReading& reading) {
  const Eigen::Vector4d value{reading.rate_rad_s.x(), reading.rate_rad_s.y(), reading.rate_rad_s.z(),
                              reading.yaw_rate_b_rad_s.value_or(kAbsent)};
  const bool b_is_sound = !reading.yaw_rate_b_rad_s || std::isfinite(*reading.yaw_rate_b_rad_s);
  if (!std::isfinite(reading.time_s) || !value.head<3>().allFinite() || !b_is_sound) {
    ++left_out_;
    return;
  }
  if (reading.saturated) {
    // The turn exceeded the range of the gyro, so its angle is unknown.
    ++left_out_;
    end_segment();
    rates_.clear();
    return;
  }
  if (!in_order(rates_, reading.time_s)) {
    ++left_out_;
    return;
  }
  rates_.add(reading.time_s, value);
  if (parameters_.tilt_lag_s > 0) inclinometer_.update(reading.time_s, Eigen::Vector3d(value.head<3>()));
}

void TurnIntegrator::test_lag() {
  for (std::uint32_t i = 0; i < compass_.size(); ++i) {
    const double time_s = compass_.time_s(i);
    if (lag_tested_s_ && time_s <= *lag_tested_s_) continue;
    if (!rates_.settled(time_s)) return;
    inclinometer_.update(time_s, Eigen::Vector2d(compass_.value(i).head<2>()));
    lag_tested_s_ = time_s;
  }
}

std::optional<TurnStep> TurnIntegrator::next(bool last) {
  if (waiting_count_ == 0) return step(last);
  const TurnStep oldest = waiting_[first_waiting_];
  first_waiting_ = (first_waiting_ + 1) % TiltSmoother::kCapacity;
  --waiting_count_;
  return oldest;
}

std::optional<TurnStep> TurnIntegrator::step(bool at_once) {
  // The turn is unknown where readings of either instrument were dropped for lack of room.
  if (given_out_s_ && (compass_.size() == 0 || compass_.time_s(0) > *given_out_s_ || rates_.size() == 0 ||
                       rates_.time_s(0) > *given_out_s_)) {
    given_out_s_.reset();
    smoother_.clear();
  }
  while (!given_out_s_ && compass_.size() > 0 && rates_.size() > 0 && compass_.time_s(0) < rates_.time_s(0)) {
    compass_.drop_oldest();
    smoother_.clear();
    ++left_out_;
  }
  std::uint32_t i = 0;
  while (i < compass_.size() && given_out_s_ && compass_.time_s(i) <= *given_out_s_) ++i;
  if (i == compass_.size()) return std::nullopt;
  const double time_s = compass_.time_s(i);
  if (!compass_.settled(time_s) || !rates_.settled(time_s)) return std::nullopt;
  if (parameters_.tilt_lag_s > 0) test_lag();
  if (inclinometer_.lags() != lags_) {
    // The step between would begin with one tilt and end with the other.
    lags_ = inclinometer_.lags();
    given_out_s_.reset();
    smoother_.clear();
  }
  const bool lags = this->lags();
  if (lags && !look_ahead(i) && !at_once && parameters_.levels_heading) return std::nullopt;
  TurnStep step;
  if (given_out_s_) {
    if (lags) tilt_ = smoother_.oldest();
    step = step_between(*given_out_s_, time_s);
    if (lags) smoother_.drop_oldest();
  }
  if (lags) tilt_ = smoother_.oldest();
  step.time_s = time_s;
  step.heading_rad = heading_of(i);
  step.roll_rad = lags ? tilt_[kRoll] : compass_.value(i)[kRoll];
  step.pitch_rad = lags ? tilt_[kPitch] : compass_.value(i)[kPitch];
  step.tilt_restored = lags;
  step.roll_lag_rad = lags ? tilt_[kRoll] - tilt_[TiltSmoother::kShownRoll] : 0;
  step.pitch_lag_rad = lags ? tilt_[kPitch] - tilt_[TiltSmoother::kShownPitch] : 0;
  given_out_s_ = time_s;
  compass_.forget_before(time_s);
  rates_.forget_before(time_s);
  return step;
}

bool TurnIntegrator::look_ahead(std::uint32_t first) {
  std::uint32_t i = first;
  if (smoother_.size() == 0) {
    ahead_s_ = compass_.time_s(i);
    smoother_.start(compass_.value(i).head<2>(), compass_.at(ahead_s_).slope.head<2>());
  }
  for (; i < compass_.size() && smoother_.size() < TiltSmoother::kCapacity; ++i) {
    const double to_s = compass_.time_s(i);
    if (to_s <= ahead_s_) continue;
    if (!rates_.settled(to_s)) break;
    // The smoother advances from one gyro reading to the next in one step.
    while (ahead_s_ < to_s) {
      std::uint32_t r = rates_.find(ahead_s_);
      if (rates_.time_s(r) <= ahead_s_) ++r;
      const double next_s = std::min(rates_.time_s(r), to_s);
      smoother_.predict(body_rate_at(ahead_s_ + (next_s - ahead_s_) / 2), next_s - ahead_s_);
      ahead_s_ = next_s;
    }
    smoother_.correct(compass_.value(i).head<2>());
  }
  return ahead_s_ >= compass_.time_s(first) + kLookAhead_s || smoother_.size() == TiltSmoother::kCapacity ||
         compass_.size() > kCrowded || rates_.size() > kCrowded;
}

TurnStep TurnIntegrator::step_between(double begin_s, double end_s) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  // All curves are smooth between two gyro readings, so Simpson's rule suffices.
  for (double from_s = begin_s; from_s < end_s;) {
    std::uint32_t i = rates_.find(from_s);
    if (rates_.time_s(i) <= from_s) ++i;
    const double to_s = std::min(rates_.time_s(i), end_s);
    const double middle_s = from_s + (to_s - from_s) / 2;
    Eigen::Vector4d weighted = turning_at(from_s);
    advance_tilt(from_s, middle_s);
    weighted += 4 * turning_at(middle_s);
    advance_tilt(middle_s, to_s);
    weighted += turning_at(to_s);
    sum += weighted * ((to_s - from_s) / 6);
    from_s = to_s;
  }
  TurnStep step;
  step.begins_segment = false;
  step.duration_s = end_s - begin_s;
  step.measured_angle_rad = sum[0];
  step.measured_angle_b_rad = sum[1];
  step.bias_time_s = sum[2];
  step.tilt_angle_rad = sum[3];
  return step;
}

Eigen::Vector4d TurnIntegrator::turning_at(double time_s) const {
  const auto compass = compass_.at(time_s);
  const Eigen::Vector4d rate = rates_.at(time_s).value;
  Eigen::Vector2d tilt = compass.value.head<2>(), slope = compass.slope.head<2>();
  if (lags()) {
    tilt = tilt_.head<2>();
    slope = TiltSmoother::slope_rad_s(tilt_, body_rate_at(time_s));
  }
  const double cos_pitch = std::cos(tilt[kPitch]);
  const double factor = 1 / (std::cos(tilt[kRoll]) * cos_pitch);
  return {factor * rate[kZ], factor * rate[kZOfB], factor, std::tan(tilt[kRoll]) / cos_pitch * slope[kPitch]};
}

Eigen::Vector3d TurnIntegrator::body_rate_at(double time_s) const {
  const Eigen::Vector4d rate = rates_.at(time_s).value;
  return {rate[kX], rate[kY], gyro_[0] * rate[kZ] + gyro_[1]};
}

void TurnIntegrator::advance_tilt(double begin_s, double end_s) {
  if (!lags()) return;
  const Eigen::Vector3d rate = body_rate_at(begin_s + (end_s - begin_s) / 2);
  const Eigen::Vector2d begin = tilt_.head<2>();
  tilt_.head<2>() += (end_s - begin_s) / 2 * TiltSmoother::slope_rad_s(tilt_, rate);
  tilt_.head<2>() = (begin + (end_s - begin_s) * TiltSmoother::slope_rad_s(tilt_, rate)).eval();
}

double TurnIntegrator::heading_of(std::uint32_t i) const {
  const auto& reading = compass_.value(i);
  const Eigen::Vector3d field = reading.tail<3>();
  if (!lags() || !parameters_.levels_heading || !field.allFinite()) return reading[kHeading];
  const double by_lag = levelled_heading(field, tilt_[kRoll], tilt_[kPitch]) -
                        levelled_heading(field, reading[kRoll], reading[kPitch]);
  return reading[kHeading] + std::remainder(by_lag, 2 * std::numbers::pi);
}

void TurnIntegrator::begin_segment() {
  compass_.clear();
  rates_.clear();
  given_out_s_.reset();
  smoother_.clear();
}

void TurnIntegrator::archive(Archive& archive) {
  archive.tag("turn_integrator 2");
  archive(inclinometer_, lag_tested_s_, lags_);
  archive(compass_, rates_, given_out_s_, smoother_, ahead_s_, tilt_, gyro_);
  archive(waiting_count_, left_out_);
  if (!archive.saving()) first_waiting_ = 0;
  if (waiting_count_ > TiltSmoother::kCapacity) waiting_count_ = 0;  // damaged
  for (std::uint32_t i = 0; i < waiting_count_; ++i) {
    archive(waiting_[(first_waiting_ + i) % TiltSmoother::kCapacity]);
  }
}

}  // namespace navcal::calib
