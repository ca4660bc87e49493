// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "config/error.h"

namespace navcal::config {

/// Bounds within which a mission may be planned (docs/gap.md, "The next mission"). SI and radians.
struct MissionLimits {
  double duration_s = 180;
  double least_depth_m = 0.15, greatest_depth_m = 3;
  double radius_m = 80;  ///< about the start, horizontally
  double least_shaft_rps = 9, greatest_shaft_rps = 16;
  double greatest_turn_rate_rad_s = 0.6;
  double greatest_pitch_rad = 0.6;
  std::optional<double> energy_J;  ///< of the motor; empty: no limit
  double battery_V = 12;           ///< its supply, for the energy

  bool operator==(const MissionLimits&) const = default;
};

/// Reads a file of limits; what it does not say has its default. Throws Error, which names line and key.
[[nodiscard]] MissionLimits load_mission_limits(const std::filesystem::path& file);
/// The same from memory; `name` stands for the file in messages. Throws Error.
[[nodiscard]] MissionLimits parse_mission_limits(std::string_view toml, std::string_view name);

}  // namespace navcal::config
