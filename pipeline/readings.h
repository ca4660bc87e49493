// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/readings.h"
#include "config/settings.h"
#include "instruments/samples.h"
#include "nav/readings.h"

// Samples as the estimators of position and tilt, and the calibrators, take them.
namespace navcal::pipeline {

/// Places of the ports' sensors, from the vehicle's origin in body axes; one for each port.
[[nodiscard]] std::vector<Eigen::Vector3d> mounted_positions_m(const config::Settings& settings);
/// Whether the receiver has a fix and states its latitude and longitude.
[[nodiscard]] bool has_position(const instruments::GpsSample& gps);
/// North and east over ground; nullopt without a fix, a speed or a course.
[[nodiscard]] std::optional<Eigen::Vector2d> ground_velocity_m_s(const instruments::GpsSample& gps);
/// Rates, and the specific force where the sample has it; the depth is left open. Nullopt without rates.
[[nodiscard]] std::optional<nav::RateReading> rate_reading(const instruments::Sample& sample,
                                                           const instruments::ImuSample& imu);
/// Velocity of a DVL at `position_m` over the bottom; nullopt without bottom lock. An error that the device states
/// as zero, as some do, is a millimetre a second.
[[nodiscard]] std::optional<nav::GroundVelocityReading> bottom_reading(const instruments::Sample& sample,
                                                                       const instruments::DvlSample& dvl,
                                                                       const Eigen::Vector3d& position_m);
/// Likewise through the water.
[[nodiscard]] std::optional<nav::WaterVelocityReading> water_reading(const instruments::Sample& sample,
                                                                     const instruments::DvlSample& dvl,
                                                                     const Eigen::Vector3d& position_m);
/// Depth that the gauge states; else that of its pressure in water of one density: (p - p_air)/(rho g). Nullopt
/// when it measured neither.
[[nodiscard]] std::optional<double> depth_m(const instruments::DepthSample& gauge,
                                            const config::NavigationSettings& settings);
/// Standard error that the gauge states of it; nullopt where it states none.
[[nodiscard]] std::optional<double> depth_std_m(const instruments::DepthSample& gauge,
                                                const config::NavigationSettings& settings);
/// nullopt without a shaft speed.
[[nodiscard]] std::optional<nav::ShaftReading> shaft_reading(const instruments::Sample& sample,
                                                             const instruments::MotorSample& motor);

/// A sample as the calibrators take it; `time_s` from an origin of the caller's choice. True headings are left
/// out, because calibrators learn magnetic ones. A sample without a magnetic heading gets that of its own field,
/// levelled by its own tilt.
[[nodiscard]] calib::CompassReading calib_reading(const instruments::CompassSample& compass,
                                                  const instruments::Stamp& stamp, double time_s);
/// Whether the calibrators learn from a sample: it has a field or a magnetic heading. A true heading is most often
/// an estimate by the same compass, and NMEA's lines of tilt or rate of turn alone are no readings of a heading.
[[nodiscard]] inline bool is_reading_of_compass(const instruments::CompassSample& compass) {
  return compass.field_body_uT || (compass.heading_rad && !compass.heading_is_true);
}
/// nullopt without rates.
[[nodiscard]] std::optional<calib::RateReading> calib_reading(const instruments::ImuSample& imu,
                                                              const instruments::Stamp& stamp, double time_s);

/// A true heading as a reference; nullopt without one, or without its standard error.
[[nodiscard]] std::optional<calib::ReferenceReading> reference_reading(const instruments::CompassSample& compass,
                                                                       const instruments::Stamp& stamp,
                                                                       double time_s);

}  // namespace navcal::pipeline
