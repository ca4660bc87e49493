// SPDX-License-Identifier: Apache-2.0
#include "pipeline/readings.h"

#include <cmath>

#include "base/gravity.h"
#include "base/vectors.h"
#include "calib/correction.h"
#include "instruments/compass_error.h"

namespace navcal::pipeline {
namespace {

constexpr double kSecondsPerMinute = 60;
constexpr double kLeastVelocityStd_m_s = 0.001;

template <class Reading>
Reading velocity_reading(const instruments::Sample& sample, instruments::VelocityFrame frame,
                         const instruments::Vector3& velocity_m_s, const std::optional<double>& std_m_s,
                         const Eigen::Vector3d& position_m) {
  Reading reading;
  reading.time_ns = sample.stamp.validity_ns;
  reading.velocity_m_s = base::vector_of(velocity_m_s);
  reading.frame = frame == instruments::VelocityFrame::body ? nav::VelocityFrame::body : nav::VelocityFrame::earth;
  // No number stays no number, and the navigator leaves it out.
  const double stated_m_s = std_m_s.value_or(kLeastVelocityStd_m_s);
  reading.std_m_s = stated_m_s >= 0 && stated_m_s < kLeastVelocityStd_m_s ? kLeastVelocityStd_m_s : stated_m_s;
  reading.position_m = position_m;
  return reading;
}

bool has_fix(const instruments::GpsSample& gps) {
  return gps.fix == instruments::Fix::fix_2d || gps.fix == instruments::Fix::fix_3d;
}

}  // namespace

std::vector<Eigen::Vector3d> mounted_positions_m(const config::Settings& settings) {
  std::vector<Eigen::Vector3d> positions_m;
  for (const auto& port : settings.ports) positions_m.push_back(base::vector_of(port.mounting.position_m));
  return positions_m;
}

bool has_position(const instruments::GpsSample& gps) {
  return has_fix(gps) && gps.latitude_rad && gps.longitude_rad;
}

std::optional<Eigen::Vector2d> ground_velocity_m_s(const instruments::GpsSample& gps) {
  if (!has_fix(gps) || !gps.speed_m_s || !gps.course_rad) return std::nullopt;
  return *gps.speed_m_s * Eigen::Vector2d(std::cos(*gps.course_rad), std::sin(*gps.course_rad));
}

std::optional<nav::RateReading> rate_reading(const instruments::Sample& sample,
                                             const instruments::ImuSample& imu) {
  if (!imu.rate_rad_s) return std::nullopt;
  nav::RateReading reading;
  reading.time_ns = sample.stamp.validity_ns;
  reading.rate_rad_s = base::vector_of(*imu.rate_rad_s);
  if (imu.specific_force_m_s2) reading.specific_force_m_s2 = base::vector_of(*imu.specific_force_m_s2);
  return reading;
}

std::optional<nav::GroundVelocityReading> bottom_reading(const instruments::Sample& sample,
                                                         const instruments::DvlSample& dvl,
                                                         const Eigen::Vector3d& position_m) {
  if (!dvl.bottom_velocity_m_s) return std::nullopt;
  return velocity_reading<nav::GroundVelocityReading>(sample, dvl.frame, *dvl.bottom_velocity_m_s,
                                                      dvl.bottom_velocity_std_m_s, position_m);
}

std::optional<nav::WaterVelocityReading> water_reading(const instruments::Sample& sample,
                                                       const instruments::DvlSample& dvl,
                                                       const Eigen::Vector3d& position_m) {
  if (!dvl.water_velocity_m_s) return std::nullopt;
  return velocity_reading<nav::WaterVelocityReading>(sample, dvl.frame, *dvl.water_velocity_m_s,
                                                     dvl.water_velocity_std_m_s, position_m);
}

std::optional<double> depth_m(const instruments::DepthSample& gauge, const config::NavigationSettings& settings) {
  if (gauge.depth_m || !gauge.pressure_Pa) return gauge.depth_m;
  return (*gauge.pressure_Pa - settings.air_pressure_Pa) / (settings.water_density_kg_m3 * base::kGravity_m_s2);
}

std::optional<double> depth_std_m(const instruments::DepthSample& gauge,
                                  const config::NavigationSettings& settings) {
  if (gauge.depth_m || !gauge.pressure_std_Pa) return gauge.depth_std_m;
  return *gauge.pressure_std_Pa / (settings.water_density_kg_m3 * base::kGravity_m_s2);
}

std::optional<nav::ShaftReading> shaft_reading(const instruments::Sample& sample,
                                               const instruments::MotorSample& motor) {
  if (!motor.rpm) return std::nullopt;
  return nav::ShaftReading{sample.stamp.validity_ns, *motor.rpm / kSecondsPerMinute};
}

calib::CompassReading calib_reading(const instruments::CompassSample& compass, const instruments::Stamp& stamp,
                                    double time_s) {
  const instruments::CompassError error(compass.error);
  calib::CompassReading reading;
  reading.time_s = time_s;
  reading.time_std_s = 1e-9 * static_cast<double>(stamp.std_ns);
  if (!compass.heading_is_true) reading.heading_rad = compass.heading_rad;
  reading.pitch_rad = compass.pitch_rad;
  reading.roll_rad = compass.roll_rad;
  if (compass.field_body_uT) reading.field_body_uT = base::vector_of(*compass.field_body_uT);
  // An inertial unit gives its field, and the heading of its filter apart from it, or for true north.
  if (!reading.heading_rad && reading.field_body_uT && compass.roll_rad && compass.pitch_rad)
    reading.heading_rad = calib::levelled_heading(*reading.field_body_uT, *compass.roll_rad, *compass.pitch_rad);
  reading.utc_ns = stamp.validity_utc_ns;
  reading.distorted = error.distortion;
  reading.tilt_out_of_range = error.tilt_out_of_range;
  reading.field_out_of_range = error.field_out_of_range;
  reading.faulty = error.unknown;
  return reading;
}

std::optional<calib::ReferenceReading> reference_reading(const instruments::CompassSample& compass,
                                                         const instruments::Stamp& stamp, double time_s) {
  if (!compass.heading_is_true || !compass.heading_rad || !(compass.heading_std_rad.value_or(0) > 0))
    return std::nullopt;
  return calib::ReferenceReading{time_s, 1e-9 * static_cast<double>(stamp.std_ns), *compass.heading_rad,
                                 *compass.heading_std_rad};
}

std::optional<calib::RateReading> calib_reading(const instruments::ImuSample& imu, const instruments::Stamp& stamp,
                                                double time_s) {
  if (!imu.rate_rad_s) return std::nullopt;
  calib::RateReading reading;
  reading.time_s = time_s;
  reading.time_std_s = 1e-9 * static_cast<double>(stamp.std_ns);
  reading.rate_rad_s = base::vector_of(*imu.rate_rad_s);
  reading.yaw_rate_b_rad_s = imu.yaw_rate_b_rad_s;
  if (imu.specific_force_m_s2) reading.specific_force_m_s2 = base::vector_of(*imu.specific_force_m_s2);
  reading.saturated = imu.over_range;
  return reading;
}

}  // namespace navcal::pipeline
