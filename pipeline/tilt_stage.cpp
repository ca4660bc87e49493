#include "pipeline/tilt_stage.h"

#include <Eigen/Core>
#include <cmath>
#include <variant>

namespace navcal::pipeline {
namespace {

constexpr double kSecondsPerMinute = 60;

Eigen::Vector3d vector(const instruments::Vector3& v) { return {v[0], v[1], v[2]}; }

nav::AccelerometerTiltOptions tilt_options(const config::Settings& settings) {
  nav::AccelerometerTiltOptions options;
  options.advance_m = settings.calibration.advance_m;
  options.speed_lag_s = settings.navigation.speed_lag_s;
  return options;
}

}  // namespace

nav::RateReading rate_reading(const instruments::Sample& sample, const instruments::ImuSample& imu) {
  nav::RateReading reading;
  reading.time_ns = sample.stamp.validity_ns;
  reading.rate_rad_s = vector(imu.rate_rad_s);
  reading.specific_force_m_s2 = vector(imu.specific_force_m_s2);
  return reading;
}

std::optional<nav::ShaftReading> shaft_reading(const instruments::Sample& sample,
                                               const instruments::MotorSample& motor) {
  if (!motor.rpm) return std::nullopt;
  return nav::ShaftReading{sample.stamp.validity_ns, *motor.rpm / kSecondsPerMinute};
}

std::unique_ptr<TiltStage> TiltStage::make(const config::Settings& settings) {
  if (candidates(settings, Role::acceleration).empty()) return nullptr;
  return std::make_unique<TiltStage>(settings);
}

TiltStage::TiltStage(const config::Settings& settings)
    : options_(tilt_options(settings)), tilt_(options_), has_inclinometer_(settings.ports.size()) {}

void TiltStage::begin_run() {
  tilt_ = nav::AccelerometerTilt(options_);
  has_inclinometer_.assign(has_inclinometer_.size(), false);
}

void TiltStage::take(const instruments::Sample& sample, const RolePorts& serving) {
  if (const auto* imu = std::get_if<instruments::ImuSample>(&sample.value)) {
    if (sample.port == serving[Role::acceleration] && !imu->over_range) tilt_.take(rate_reading(sample, *imu));
  } else if (const auto* motor = std::get_if<instruments::MotorSample>(&sample.value)) {
    const auto reading = shaft_reading(sample, *motor);
    if (reading && sample.port == serving[Role::shaft]) tilt_.take(*reading);
  } else if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value)) {
    if (sample.port != serving[Role::velocity] || !roles_of(sample).has(Role::velocity)) return;
    nav::FixReading reading;
    reading.time_ns = sample.stamp.validity_ns;
    reading.velocity_m_s =
        *gps->speed_m_s * Eigen::Vector2d(std::cos(*gps->course_rad), std::sin(*gps->course_rad));
    tilt_.take(reading);
  }
}

void TiltStage::fill(instruments::Sample& sample) {
  auto* const compass = std::get_if<instruments::CompassSample>(&sample.value);
  if (compass == nullptr) return;
  if (compass->pitch_rad || compass->roll_rad) has_inclinometer_.at(sample.port) = true;
  if (has_inclinometer_.at(sample.port) || compass->error) return;
  if (!compass->heading_rad && !compass->field_body_uT) return;
  const auto tilt = tilt_.at(sample.stamp.validity_ns);
  if (!tilt) return;
  compass->roll_rad = tilt->roll_rad;
  compass->pitch_rad = tilt->pitch_rad;
  compass->tilt_by_accelerometers = true;
}

}  // namespace navcal::pipeline
