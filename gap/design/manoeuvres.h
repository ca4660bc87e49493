// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/mission.h"
#include "config/mission_limits.h"

namespace navcal::gap {

/// A part of a mission that may be chosen: one or more steps in the words of a mission file (docs/simulator.md).
struct ManoeuvreChoice {
  std::string name;                ///< for people: "circle to starboard at 20 deg/s, 1.5 m deep"
  std::vector<std::string> steps;  ///< "{do = \"circle\", turns = 1, rate_deg_s = 20}"
  double seconds = 0;              ///< about; the simulation tells
};

/// The alphabet of manoeuvres within the limits: legs at several headings and speeds, circles both ways at several
/// rates, zigzags, doublets of rudder, elevator and each fin, dives and rises, steps of speed, rest at the
/// surface, and reciprocal legs with fixes.
[[nodiscard]] std::vector<ManoeuvreChoice> manoeuvre_alphabet(const config::MissionLimits& limits);

/// A mission file of these manoeuvres, one after the other, that begins at the surface and holds its last course
/// at the end. `title` is its description.
[[nodiscard]] std::string mission_file_of(const std::vector<const ManoeuvreChoice*>& chosen,
                                          const config::MissionLimits& limits, const std::string& title);

}  // namespace navcal::gap
