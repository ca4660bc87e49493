// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "config/error.h"
#include "config/option.h"

namespace navcal::config {

/// Limits within which a mission is planned (navcal gap next --limits), SI and radians.
struct MissionLimits {
  double duration_s = 600;
  double least_depth_m = 0.15;  ///< of the vehicle's origin; above 0.2 m no step goes to the surface
  double greatest_depth_m = 4;
  double range_m = 60;  ///< horizontal distance from where the mission begins
  double speed_m_s = 1.5;
  double shaft_rps = 20;
  double turn_rad_s = 45 * std::numbers::pi / 180;  ///< rate of the heading, either way
  double energy_Wh = 40;                            ///< of motor and all other consumers
  double supply_V = 22.5;
  double hotel_A = 0.5;  ///< current of all consumers but the motor

  bool operator==(const MissionLimits&) const = default;
};

/// Options of the table [limits].
[[nodiscard]] const std::vector<Option<MissionLimits>>& mission_limit_options();

/// Limits from memory, with defaults for keys that are not given; `name` stands for the file in messages. Throws
/// Error with file, line and key.
[[nodiscard]] MissionLimits parse_mission_limits(std::string_view toml, std::string_view name);
[[nodiscard]] MissionLimits load_mission_limits(const std::filesystem::path& file);

/// A file of limits with a comment for each key.
[[nodiscard]] std::string mission_limits_file(const MissionLimits& limits);

}  // namespace navcal::config
