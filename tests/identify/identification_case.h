// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/layout.h"
#include "identify/answer/simulated_motion.h"
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
/// Doppler log), "reference" (with the reference instruments), "micro" (four thrusters, inertial unit and depth).
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

/// The part of a recording from one time to another.
[[nodiscard]] RecordedMotion part_of(const RecordedMotion& motion, double from_s, double to_s);

}  // namespace navcal::identify
