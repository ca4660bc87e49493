#include "calib/turn_integrator.h"

#include <cmath>

namespace navcal::calib {
namespace {

/// Steeper than about 80 degrees roll and heading lose their meaning, and compasses give up.
constexpr double kSmallestCosine = 0.17;

}  // namespace

template <class Curve>
bool TurnIntegrator::in_order(Curve& curve, double time_s) {
  if (curve.size() == 0) return true;
  const double since_s = time_s - curve.time_s(curve.size() - 1);
  if (std::abs(since_s) > parameters_.longest_gap_s) {
    // Backwards it is another clock, on which nothing held here has a place.
    if (since_s < 0) begin_segment();
    curve.clear();
    given_out_s_.reset();
    return true;
  }
  return since_s > 0;
}

void TurnIntegrator::update(const CompassReading& reading) {
  if (!std::isfinite(reading.time_s) || reading.faulty || !reading.heading_rad || !reading.roll_rad ||
      !reading.pitch_rad) {
    ++left_out_;
    return;
  }
  const Eigen::Vector3d value{*reading.roll_rad, *reading.pitch_rad, *reading.heading_rad};
  if (!value.allFinite() || std::cos(value[kRoll]) < kSmallestCosine ||
      std::cos(value[kPitch]) < kSmallestCosine || !in_order(compass_, reading.time_s)) {
    ++left_out_;
    return;
  }
  compass_.add(reading.time_s, value);
}

void TurnIntegrator::update(const RateReading& reading) {
  const Eigen::Vector4d value{reading.rate_rad_s.x(), reading.rate_rad_s.y(), reading.rate_rad_s.z(),
                              reading.yaw_rate_b_rad_s};
  if (!std::isfinite(reading.time_s) || !value.allFinite()) {
    ++left_out_;
    return;
  }
  if (reading.saturated) {
    // The turn was faster than anybody knows.
    ++left_out_;
    rates_.clear();
    given_out_s_.reset();
    return;
  }
  if (!in_order(rates_, reading.time_s)) {
    ++left_out_;
    return;
  }
  rates_.add(reading.time_s, value);
}

std::optional<TurnStep> TurnIntegrator::next() {
  // Nothing is known of the turn where either was dropped for lack of room.
  if (given_out_s_ && (compass_.size() == 0 || compass_.time_s(0) > *given_out_s_ || rates_.size() == 0 ||
                       rates_.time_s(0) > *given_out_s_)) {
    given_out_s_.reset();
  }
  while (!given_out_s_ && compass_.size() > 0 && rates_.size() > 0 && compass_.time_s(0) < rates_.time_s(0)) {
    compass_.drop_oldest();
    ++left_out_;
  }
  std::uint32_t i = 0;
  while (i < compass_.size() && given_out_s_ && compass_.time_s(i) <= *given_out_s_) ++i;
  if (i == compass_.size()) return std::nullopt;
  const double time_s = compass_.time_s(i);
  if (!compass_.settled(time_s) || !rates_.settled(time_s)) return std::nullopt;
  TurnStep step;
  if (given_out_s_) {
    step = step_between(*given_out_s_, time_s);
  } else {
    lagged_slope_rad_s_ = compass_.at(time_s).slope.head<2>();
  }
  step.time_s = time_s;
  step.heading_rad = compass_.value(i)[kHeading];
  given_out_s_ = time_s;
  compass_.forget_before(time_s);
  rates_.forget_before(time_s);
  return step;
}

TurnStep TurnIntegrator::step_between(double begin_s, double end_s) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  // From one gyro reading to the next everything is smooth, so Simpson's rule will do.
  for (double from_s = begin_s; from_s < end_s;) {
    std::uint32_t i = rates_.find(from_s);
    if (rates_.time_s(i) <= from_s) ++i;
    const double to_s = std::min(rates_.time_s(i), end_s);
    const double middle_s = from_s + (to_s - from_s) / 2;
    Eigen::Vector4d weighted = turning_at(from_s);
    advance_lag(from_s, middle_s);
    weighted += 4 * turning_at(middle_s);
    advance_lag(middle_s, to_s);
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
  if (parameters_.tilt_lag_s > 0) {
    tilt += parameters_.tilt_lag_s * lagged_slope_rad_s_;
    slope += tilt_slope_at(time_s) - lagged_slope_rad_s_;
  }
  const double cos_pitch = std::cos(tilt[kPitch]);
  const double factor = 1 / (std::cos(tilt[kRoll]) * cos_pitch);
  return {factor * rate[kZ], factor * rate[kZOfB], factor, std::tan(tilt[kRoll]) / cos_pitch * slope[kPitch]};
}

Eigen::Vector2d TurnIntegrator::tilt_slope_at(double time_s) const {
  const Eigen::Vector4d rate = rates_.at(time_s).value;
  const Eigen::Vector2d tilt = compass_.at(time_s).value.head<2>() + parameters_.tilt_lag_s * lagged_slope_rad_s_;
  const double sin_roll = std::sin(tilt[kRoll]), cos_roll = std::cos(tilt[kRoll]);
  return {rate[kX] + std::tan(tilt[kPitch]) * (sin_roll * rate[kY] + cos_roll * rate[kZ]),
          cos_roll * rate[kY] - sin_roll * rate[kZ]};
}

void TurnIntegrator::advance_lag(double begin_s, double end_s) {
  if (parameters_.tilt_lag_s <= 0) return;
  const Eigen::Vector2d slope = tilt_slope_at(begin_s + (end_s - begin_s) / 2);
  lagged_slope_rad_s_ += -std::expm1((begin_s - end_s) / parameters_.tilt_lag_s) * (slope - lagged_slope_rad_s_);
}

void TurnIntegrator::begin_segment() {
  compass_.clear();
  rates_.clear();
  given_out_s_.reset();
}

void TurnIntegrator::archive(Archive& archive) {
  archive.tag("turn_integrator 1");
  archive(compass_, rates_, given_out_s_, lagged_slope_rad_s_, left_out_);
}

}  // namespace navcal::calib
