// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tilt_stage.h"

#include <variant>

#include "pipeline/readings.h"

namespace navcal::pipeline {
namespace {

nav::AccelerometerTiltOptions tilt_options(const config::Settings& settings) {
  nav::AccelerometerTiltOptions options;
  options.advance_m = settings.calibration.advance_m;
  options.speed_lag_s = settings.navigation.speed_lag_s;
  return options;
}

}  // namespace

std::unique_ptr<TiltStage> TiltStage::make(const config::Settings& settings) {
  if (candidates(settings, Role::acceleration).empty()) return nullptr;
  return std::make_unique<TiltStage>(settings);
}

TiltStage::TiltStage(const config::Settings& settings)
    : ports_(Sources(settings).serving()), options_(tilt_options(settings)), tilt_(options_),
      positions_m_(mounted_positions_m(settings)), has_inclinometer_(settings.ports.size()) {}

void TiltStage::begin_run() {
  tilt_ = nav::AccelerometerTilt(options_);
  has_inclinometer_.assign(has_inclinometer_.size(), false);
}

void TiltStage::take(const instruments::Sample& sample) {
  if (const auto* imu = std::get_if<instruments::ImuSample>(&sample.value)) {
    if (sample.port != ports_[Role::acceleration] || imu->over_range) return;
    auto reading = rate_reading(sample, *imu);
    if (!reading) return;
    reading->force_position_m = positions_m_.at(sample.port);
    tilt_.take(*reading);
  } else if (const auto* motor = std::get_if<instruments::MotorSample>(&sample.value)) {
    const auto reading = shaft_reading(sample, *motor);
    if (reading && sample.port == ports_[Role::shaft]) tilt_.take(*reading);
  } else if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value)) {
    if (sample.port != ports_[Role::velocity]) return;
    nav::FixReading reading;
    reading.time_ns = sample.stamp.validity_ns;
    reading.velocity_m_s = ground_velocity_m_s(*gps);
    tilt_.take(reading);
  }
}

std::optional<instruments::Sample> TiltStage::with_tilt(const instruments::Sample& sample) {
  const auto* const compass = std::get_if<instruments::CompassSample>(&sample.value);
  if (compass == nullptr) return std::nullopt;
  if (compass->pitch_rad || compass->roll_rad) has_inclinometer_.at(sample.port) = true;
  if (has_inclinometer_.at(sample.port) || compass->error) return std::nullopt;
  if (!compass->heading_rad && !compass->field_body_uT) return std::nullopt;
  const auto tilt = tilt_.at(sample.stamp.validity_ns);
  if (!tilt) return std::nullopt;
  instruments::Sample filled = sample;
  auto& word = std::get<instruments::CompassSample>(filled.value);
  word.roll_rad = tilt->roll_rad;
  word.pitch_rad = tilt->pitch_rad;
  word.tilt_by_accelerometers = true;
  return filled;
}

}  // namespace navcal::pipeline
