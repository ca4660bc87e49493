// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "config/settings.h"
#include "instruments/samples.h"
#include "nav/readings.h"

// Samples as the estimators of position and tilt take them.
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

}  // namespace navcal::pipeline
