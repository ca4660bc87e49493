// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/layout.h"
#include "identify/answer/manoeuvres.h"
#include "identify/parameters.h"

namespace navcal::identify {

/// A shipped layout with what is uncertain about it, and what it is driven and measured with.
struct VehicleCase {
  std::string name;
  config::Layout prior;
  std::vector<ChannelNoise> channels;
  bool reports_positions = false;
};

/// "rov" (BlueROV2 heavy with an inertial unit, attitude, depth and a Doppler log), "rov-imu" (the same without a
/// Doppler log), "ferry" (four thrusters, stabilised by righting moments), "reference" (with the reference
/// instruments), "micro" (four thrusters, inertial unit and depth).
[[nodiscard]] VehicleCase vehicle_case(const std::string& name);

/// A vehicle whose numbers are drawn from the prior, and recordings of it.
struct DrawnVehicle {
  Eigen::VectorXd truth;
  config::Layout layout;
};
[[nodiscard]] DrawnVehicle draw_vehicle(const VehicleCase& of, std::uint64_t seed);

/// A recording with instruments whose errors are drawn too, `instrument_errors` times as large as their priors
/// say. Legs of random forces and moments, held level by feedback.
[[nodiscard]] RecordedMotion draw_recording(const VehicleCase& of, const config::Layout& truth, double seconds,
                                            std::uint64_t seed, double instrument_errors = 1);

/// The ferry on station under a controller whose commands the thrusters get kFerryDelay_s late, among gusts of
/// 0.08 m/s2 in surge and sway and 0.03 rad/s2 in yaw that last for 12 s: attitude, rates, fixes and the velocity
/// over the bottom five times a second. Every 30 s the station is another.
inline constexpr double kFerryDelay_s = 0.8;
[[nodiscard]] RecordedMotion draw_steered(const config::Layout& truth, double seconds, std::uint64_t seed);

/// Force over mass of a layout in surge, sway and yaw, over that of another.
[[nodiscard]] Eigen::Vector3d force_over_mass(const config::Layout& of, const config::Layout& truth);

/// The part of a recording from one time to another.
[[nodiscard]] RecordedMotion part_of(const RecordedMotion& motion, double from_s, double to_s);

}  // namespace navcal::identify
