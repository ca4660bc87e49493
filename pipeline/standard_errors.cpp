// SPDX-License-Identifier: Apache-2.0
#include "pipeline/standard_errors.h"

#include <algorithm>
#include <variant>

namespace navcal::pipeline {
namespace {

/// A receiver with a good sky has this dilution of precision; the noise of the configuration is meant for it.
constexpr double kGoodDop = 2;

/// Only what was measured has an error.
void complete_error(std::optional<double>& error, bool is_measured, double by_configuration) {
  if (is_measured && !error) error = by_configuration;
}

}  // namespace

StandardErrors::StandardErrors(const config::Settings& settings)
    : instruments_(devices::instrument_model(settings)),
      heading_std_rad_(instruments_.compass.heading_noise_rad()),
      tilt_std_rad_(instruments_.compass.tilt_reading_noise_rad()),
      fin_std_rad_(instruments_.motor.fin_report_noise_rad()),
      altitude_std_m_(settings.navigation.altitude_noise_m), dvl_std_m_s_(settings.navigation.dvl_noise_m_s) {}

void StandardErrors::complete(instruments::Sample& sample) const {
  std::visit([this](auto& value) { complete(value); }, sample.value);
}

void StandardErrors::complete(instruments::CompassSample& compass) const {
  complete_error(compass.heading_std_rad, compass.heading_rad.has_value(), heading_std_rad_);
  complete_error(compass.tilt_std_rad, compass.pitch_rad || compass.roll_rad, tilt_std_rad_);
  complete_error(compass.field_std_uT, compass.field_body_uT.has_value(), instruments_.compass.field_noise_uT);
}

void StandardErrors::complete(instruments::ImuSample& imu) const {
  complete_error(imu.rate_std_rad_s, imu.rate_rad_s.has_value(), instruments_.imu.gyro_noise_rad_s);
  complete_error(imu.specific_force_std_m_s2, imu.specific_force_m_s2.has_value(),
                 instruments_.imu.force_noise_m_s2);
  complete_error(imu.depth_std_m, imu.depth_m.has_value(), instruments_.imu.depth_noise_m);
}

void StandardErrors::complete(instruments::GpsSample& gps) const {
  const double dilution = std::max(1.0, gps.dop.value_or(kGoodDop) / kGoodDop);
  complete_error(gps.position_std_m, gps.latitude_rad && gps.longitude_rad,
                 instruments_.gps.position_noise_m * dilution);
  complete_error(gps.velocity_std_m_s, gps.speed_m_s.has_value(), instruments_.gps.velocity_noise_m_s);
}

void StandardErrors::complete(instruments::MotorSample& motor) const {
  const bool has_fins = std::any_of(motor.fins_rad.begin(), motor.fins_rad.end(),
                                    [](const auto& fin_rad) { return fin_rad.has_value(); });
  complete_error(motor.fins_std_rad, has_fins, fin_std_rad_);
  complete_error(motor.current_std_A, motor.current_A.has_value(), instruments_.motor.current_noise_A);
}

void StandardErrors::complete(instruments::AltimeterSample& altimeter) const {
  complete_error(altimeter.altitude_std_m, true, altitude_std_m_);
}

void StandardErrors::complete(instruments::DvlSample& dvl) const {
  complete_error(dvl.bottom_velocity_std_m_s, dvl.bottom_velocity_m_s.has_value(), dvl_std_m_s_);
  complete_error(dvl.water_velocity_std_m_s, dvl.water_velocity_m_s.has_value(), dvl_std_m_s_);
  complete_error(dvl.altitude_std_m, dvl.altitude_m.has_value(), altitude_std_m_);
}

}  // namespace navcal::pipeline
