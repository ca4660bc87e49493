// SPDX-License-Identifier: Apache-2.0
#include "daemon/state_collector.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "base/angles.h"
#include "base/rotation.h"
#include "base/vectors.h"

namespace navcal::daemon {
namespace {

using config::Role;

constexpr double kMostCarried_s = 0.5;
constexpr std::uint64_t kFewestReadings = 10;
/// Number of readings over which the spread is averaged, approximately.
constexpr double kRememberedReadings = 50;
constexpr double kEarthRadius_m = 6371000;

double seconds_between(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

double turned(double heading_rad, double by_rad) {
  const double sum = std::fmod(heading_rad + by_rad, 2 * std::numbers::pi);
  return sum < 0 ? sum + 2 * std::numbers::pi : sum;
}

bool has_heading(const instruments::CompassSample& compass) {
  return compass.heading_rad || compass.heading_calibrated_rad;
}

/// Rates of roll, pitch and heading at given body rates (Fossen, Handbook of Marine Craft Hydrodynamics and
/// Motion Control, eq. 2.28).
struct AngleRates {
  double roll_rad_s = 0, pitch_rad_s = 0, heading_rad_s = 0;
};

AngleRates angle_rates(const std::array<double, 3>& body_rad_s, double roll_rad, double pitch_rad) {
  const double across = body_rad_s[1] * std::sin(roll_rad) + body_rad_s[2] * std::cos(roll_rad);
  // Near the vertical a heading means nothing.
  const double cos_pitch = std::copysign(std::max(std::abs(std::cos(pitch_rad)), 0.1), std::cos(pitch_rad));
  return {body_rad_s[0] + across * std::sin(pitch_rad) / cos_pitch,
          body_rad_s[1] * std::cos(roll_rad) - body_rad_s[2] * std::sin(roll_rad), across / cos_pitch};
}

}  // namespace

void Spread::add(double difference) {
  ++count_;
  const double weight = 1 / std::min(static_cast<double>(count_), kRememberedReadings);
  mean_square_ += weight * (difference * difference - mean_square_);
}

std::optional<double> Spread::std() const {
  if (count_ < kFewestReadings) return std::nullopt;
  return std::sqrt(mean_square_);
}

StateCollector::StateCollector(const config::Settings& settings, const pipeline::Pipeline& pipeline)
    : settings_(settings), pipeline_(pipeline), last_(settings.ports.size()) {}

void StateCollector::take(const instruments::Sample& sample) {
  Last& last = last_[sample.port];
  if (const auto* compass = std::get_if<instruments::CompassSample>(&sample.value)) {
    // One device may send heading and field apart.
    if (has_heading(*compass) || !last.compass || !has_heading(last.compass->value))
      last.compass = {sample.stamp, *compass, sample.port};
  } else if (const auto* imu = std::get_if<instruments::ImuSample>(&sample.value)) {
    last.imu = {sample.stamp, *imu, sample.port};
  } else if (const auto* motor = std::get_if<instruments::MotorSample>(&sample.value)) {
    last.motor = {sample.stamp, *motor, sample.port};
  } else if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value)) {
    if (gps->latitude_rad && gps->longitude_rad) last.fix = {sample.stamp, *gps, sample.port};
  }
}

double StateCollector::gauge_below_origin_m(std::uint16_t port) const {
  const auto& position_m = settings_.ports[port].mounting.position_m;
  if (position_m == std::array<double, 3>{}) return 0;
  const auto navigation = pipeline_.navigation();
  const nav::Estimate estimate = navigation ? navigation->estimate : nav::Estimate{};
  return base::depth_below_origin_m(base::vector_of(position_m), estimate.roll_rad.value_or(0),
                                    estimate.pitch_rad.value_or(0));
}

bool StateCollector::is_serving_compass(const instruments::Sample& sample) const {
  const auto* compass = std::get_if<instruments::CompassSample>(&sample.value);
  return compass != nullptr && has_heading(*compass) &&
         pipeline_.sources()[Role::heading].value_or(sample.port) == sample.port;
}

std::string_view StateCollector::heading_source() const {
  const auto compass = serving().compass;
  if (!compass || !has_heading(compass->value)) return {};
  if (compass->value.heading_calibrated_rad) return "calibration";
  return settings_.ports[compass->port].protocol == protocols::Protocol::mavlink ? "autopilot" : "device";
}

StateCollector::Last StateCollector::serving() const {
  const auto sources = pipeline_.sources();
  // A pipeline without estimator and calibrators selects no sources; then the first device with data is used.
  const auto pick = [&](Role role, auto Last::*kind) {
    using Kind = std::remove_cvref_t<decltype(std::declval<Last>().*kind)>;
    if (const auto port = sources[role]) return Kind(last_[*port].*kind);
    const auto found = std::ranges::find_if(last_, [&](const Last& last) { return (last.*kind).has_value(); });
    return found != last_.end() ? Kind((*found).*kind) : Kind();
  };
  Last last;
  last.compass = pick(Role::heading, &Last::compass);
  last.imu = pick(Role::rates, &Last::imu);
  last.motor = pick(Role::shaft, &Last::motor);
  last.fix = pick(Role::position, &Last::fix);
  return last;
}

VehicleState StateCollector::at(std::int64_t now_ns) {
  Last last = serving();
  if (auto& imu = last.imu; imu && imu->value.depth_m) *imu->value.depth_m -= gauge_below_origin_m(imu->port);
  VehicleState state;
  if (pipeline_.mapping().source != pipeline::UtcMapping::Source::none)
    state.time_utc_ns = pipeline_.mapping().to_utc(now_ns);
  const bool is_true = last.compass && last.compass->value.heading_is_true;
  const bool has_declination = pipeline_.earth_field().declination_source != pipeline::EarthField::Source::none;
  state.is_north_true = is_true || has_declination;
  const auto age = [&](const auto& newest) -> std::optional<double> {
    if (!newest) return std::nullopt;
    return seconds_between(newest->stamp.validity_ns, now_ns);
  };
  state.compass_age_s = age(last.compass);
  state.imu_age_s = age(last.imu);
  state.gps_age_s = age(last.fix);
  state.motor_age_s = age(last.motor);
  if (last.imu) {
    state.time_std_s = static_cast<double>(last.imu->stamp.std_ns) * 1e-9;
    state.rate_rad_s = last.imu->value.rate_rad_s;
    if (state.rate_rad_s && last.imu->value.yaw_rate_calibrated_rad_s)
      (*state.rate_rad_s)[2] = *last.imu->value.yaw_rate_calibrated_rad_s;
  } else if (last.compass) {
    state.time_std_s = static_cast<double>(last.compass->stamp.std_ns) * 1e-9;
  }
  if (last.motor) {
    state.shaft_rpm = last.motor->value.rpm;
    for (std::size_t i = 0; i < state.fins_deg.size(); ++i) {
      if (const auto& fin_rad = last.motor->value.fins_rad[i])
        state.fins_deg[i] = *fin_rad * base::kDegreesPerRadian;
    }
  }
  take_estimate(state, last, now_ns);
  take_battery(state);
  return state;
}

void StateCollector::take_battery(VehicleState& state) const {
  const auto battery = pipeline_.battery();
  if (!battery) return;
  state.battery_V = battery->voltage_V;
  if (!battery->charge) return;
  state.charge_Ah = battery->charge->charge_Ah;
  state.charge_std_Ah = battery->charge->std_Ah;
}

/// Takes attitude and depth as the instruments measured them; used without an estimator.
void StateCollector::take_compass(VehicleState& state, const Last& last) const {
  if (last.compass) {
    const auto& compass = last.compass->value;
    state.heading_rad = compass.heading_calibrated_rad ? compass.heading_calibrated_rad : compass.heading_rad;
    if (state.heading_rad && !compass.heading_is_true)
      state.heading_rad = turned(*state.heading_rad, pipeline_.earth_field().declination_rad);
    state.pitch_rad = compass.pitch_rad;
    state.roll_rad = compass.roll_rad;
  }
  if (last.imu) state.depth_m = last.imu->value.depth_m;
  if (last.fix) {
    state.latitude_rad = last.fix->value.latitude_rad;
    state.longitude_rad = last.fix->value.longitude_rad;
  }
}

void StateCollector::take_estimate(VehicleState& state, const Last& last, std::int64_t now_ns) {
  const auto navigation = pipeline_.navigation();
  if (!navigation) return take_compass(state, last);
  const nav::Estimate& estimate = navigation->estimate;
  state.altitude_m = navigation->altitude_m;
  state.altitude_std_m = navigation->altitude_std_m;
  const double ahead_s = std::clamp(seconds_between(estimate.time_ns, now_ns), 0.0, kMostCarried_s);
  AngleRates rates;
  if (state.rate_rad_s && state.imu_age_s < kMostCarried_s)
    rates = angle_rates(*state.rate_rad_s, estimate.roll_rad.value_or(0), estimate.pitch_rad.value_or(0));
  const auto carried = [&](const std::optional<double>& value, double rate) -> std::optional<double> {
    if (!value) return std::nullopt;
    return *value + rate * ahead_s;
  };
  if (estimate.heading_rad) {
    state.heading_rad = turned(*estimate.heading_rad, rates.heading_rad_s * ahead_s);
    state.heading_std_rad = estimate.heading_std_rad;
  }
  state.pitch_rad = carried(estimate.pitch_rad, rates.pitch_rad_s);
  state.roll_rad = carried(estimate.roll_rad, rates.roll_rad_s);
  state.speed_m_s = estimate.speed_m_s;
  if (estimate.speed_m_s) state.speed_std_m_s = settings_.navigation.speed_error * std::abs(*estimate.speed_m_s);
  const auto velocity_m_s = estimate.velocity_m_s;
  if (velocity_m_s) state.climb_m_s = -velocity_m_s->z();
  state.depth_m = carried(estimate.depth_m, velocity_m_s ? velocity_m_s->z() : 0);
  if (navigation->latitude_rad && navigation->longitude_rad) {
    // A step of at most a metre: the Earth is a ball.
    const double north_m = velocity_m_s ? velocity_m_s->x() * ahead_s : 0;
    const double east_m = velocity_m_s ? velocity_m_s->y() * ahead_s : 0;
    state.latitude_rad = *navigation->latitude_rad + north_m / kEarthRadius_m;
    state.longitude_rad = *navigation->longitude_rad +
                          east_m / (kEarthRadius_m * std::max(0.01, std::cos(*navigation->latitude_rad)));
    state.position_std_m = estimate.position_std_m.norm();
  }
  // The spread of the newest readings about the estimate gives their standard deviation.
  if (last.compass && last.compass->value.pitch_rad && estimate.pitch_rad &&
      last.compass->stamp.validity_ns != pitch_ns_) {
    pitch_ns_ = last.compass->stamp.validity_ns;
    const double then_rad = *estimate.pitch_rad + rates.pitch_rad_s * seconds_between(estimate.time_ns, pitch_ns_);
    pitch_.add(*last.compass->value.pitch_rad - then_rad);
  }
  if (last.imu && last.imu->value.depth_m && estimate.depth_m && last.imu->stamp.validity_ns != depth_ns_) {
    depth_ns_ = last.imu->stamp.validity_ns;
    depth_.add(*last.imu->value.depth_m - *estimate.depth_m);
  }
  state.pitch_std_rad = pitch_.std();
  state.depth_std_m = depth_.std();
}

}  // namespace navcal::daemon
