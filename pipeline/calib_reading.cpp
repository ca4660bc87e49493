// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calib_reading.h"

#include "base/vectors.h"
#include "calib/correction.h"
#include "instruments/compass_error.h"

namespace navcal::pipeline {
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
