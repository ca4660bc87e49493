// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gap/data/mission.h"

namespace navcal::gap {

/// Length of a window of fingerprints and outlines, s.
inline constexpr double kOutlineWindow_s = 10;

/// Root mean square difference of two fingerprints, in tolerances; infinite between missions of different
/// lengths. Both have one row of features for each window, in units of their tolerances (kSameShaft_rps ...).
[[nodiscard]] double fingerprint_distance(std::span<const double> a, std::span<const double> b);

/// What null missions depend on, read off the instruments without a replay: for tens of thousands of missions,
/// whose banks are planned before they are made. The cache decides by the replayed course (BankCache).
struct MissionOutline {
  /// Shaft speed, turn rate, depth and fixes of each window, as in a fingerprint. Empty: the mission cannot be
  /// diagnosed.
  std::vector<double> features;
  Vector3 field_uT{};  ///< the Earth's, north, east, down
  bool field_is_fitted = false;
  std::uint32_t instruments = 0;  ///< checksum of the instrument model
};

[[nodiscard]] MissionOutline outline_of(const Mission& mission);

/// Whether one null bank serves both missions, as far as their instruments tell. Stricter than the cache, because
/// readings have errors that a replayed course has not.
[[nodiscard]] bool are_alike(const MissionOutline& a, const MissionOutline& b);

}  // namespace navcal::gap
