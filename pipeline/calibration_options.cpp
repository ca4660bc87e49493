// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibration_options.h"

#include <cmath>

namespace navcal::pipeline {
namespace {

/// The inertial card's own, where the configuration says no rate.
constexpr double kUsualRate_Hz = 20;
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

calib::SuiteOptions suite_options(const config::Settings& settings, const CalibratedPorts& ports) {
  const auto& c = settings.calibration;
  calib::SuiteOptions options;
  options.gate.motor_settle_s = c.motor_settle_s;
  options.automatic = c.automatic;
  options.margin = c.margin;
  options.heading_noise_rad = c.heading_noise_rad;
  const double rate_Hz = ports.imu ? settings.ports[*ports.imu].rate_Hz : 0;
  options.rate_noise_rad_sqrt_s = c.gyro_noise_rad_s / std::sqrt(rate_Hz > 0 ? rate_Hz : kUsualRate_Hz);
  options.bias_walk_rad_s_sqrt_s = c.bias_walk_rad_s;
  options.field_noise_uT = c.field_noise_uT;
  options.tilt_lag_s = c.tilt_lag_s;
  options.local_field = local_field(EarthField(settings.environment));
  options.position_noise_m = c.position_noise_m;
  options.velocity_noise_m_s = c.velocity_noise_m_s;
  options.current_m_s = c.current_m_s;
  options.advance_m = c.advance_m;
  return options;
}

}  // namespace navcal::pipeline
