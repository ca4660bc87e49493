// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibration_options.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/reference_instruments.h"
#include "devices/instrument_model.h"

namespace navcal::pipeline {
namespace {

/// How well size and dip are known from the configuration. The model knows nothing of rock, quays and ships near
/// the vehicle, so that it is trusted less.
constexpr double kFieldShare = 0.01, kDipStd_rad = 0.01;
constexpr double kModelShare = 0.05, kModelDipStd_rad = 0.05;

}  // namespace

calib::LocalField local_field(const EarthField& field) {
  calib::LocalField local;
  local.declination_rad = field.declination_rad;
  if (field.size_uT > 0) {
    const bool by_model = field.size_source == EarthField::Source::model;
    local.known = {field.size_uT, field.dip_rad, (by_model ? kModelShare : kFieldShare) * field.size_uT,
                   by_model ? kModelDipStd_rad : kDipStd_rad};
  }
  return local;
}

ReckonedNoise reckoned_noise(const config::Settings& settings) {
  namespace reference = base::reference;
  const devices::CompassModel compass = devices::instrument_model(settings).compass, usual;
  // Weights are inverse variances: of readings without noise they would be infinite.
  constexpr double kLeastHeading_rad = 0.01 * base::kRadiansPerDegree, kLeastField_uT = 0.001;
  const auto stated_or = [](double stated, double least, double otherwise) {
    return stated > 0 ? std::max(stated, least) : otherwise;
  };
  return {
      stated_or(settings.calibration.heading_noise_rad, kLeastHeading_rad,
                reference::kReckonedHeadingNoise_rad * (compass.heading_noise_rad() / usual.heading_noise_rad())),
      stated_or(settings.calibration.field_noise_uT, kLeastField_uT,
                reference::kReckonedFieldNoise_uT * (compass.field_noise_uT / usual.field_noise_uT)),
      reference::kReckonedTiltNoise_rad * (compass.tilt_reading_noise_rad() / usual.tilt_reading_noise_rad())};
}

calib::SuiteOptions suite_options(const config::Settings& settings, const CalibratedPorts& ports) {
  const auto& c = settings.calibration;
  calib::SuiteOptions options;
  options.gate.motor_settle_s = c.motor_settle_s;
  options.automatic = c.automatic;
  options.margin = c.margin;
  const devices::InstrumentModel instruments = devices::instrument_model(settings);
  const ReckonedNoise noise = reckoned_noise(settings);
  options.heading_noise_rad = noise.heading_rad;
  const double stated_Hz = ports.imu ? settings.ports[*ports.imu].rate_Hz : 0;
  const double rate_Hz = stated_Hz > 0 ? stated_Hz : instruments.imu.timing.rate_Hz;
  options.rate_noise_rad_sqrt_s = instruments.imu.gyro_noise_rad_s / std::sqrt(rate_Hz);
  options.bias_walk_rad_s_sqrt_s = c.bias_walk_rad_s;
  options.field_noise_uT = noise.field_uT;
  options.tilt_noise_rad = noise.tilt_rad;
  options.tilt_lag_s = instruments.compass.tilt_lag_s;
  options.local_field = local_field(EarthField(settings.environment));
  options.position_noise_m = instruments.gps.position_noise_m;
  options.velocity_noise_m_s = instruments.gps.velocity_noise_m_s;
  options.current_m_s = c.current_m_s;
  options.advance_m = c.advance_m;
  return options;
}

}  // namespace navcal::pipeline
