// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fleet/causes/cause_search.h"
#include "fleet/causes/pooled_missions.h"

namespace navcal::fleet {

enum class FleetVerdict : std::uint8_t {
  no_gap,     ///< the missions of the vehicle show no gap, and no cause belongs to it
  explained,  ///< the causes close the gap of its missions
  unknown,    ///< there is a gap that they do not close, or no cause is probable enough
};
/// "no-gap", "explained", "unknown".
[[nodiscard]] std::string_view name_of(FleetVerdict verdict);

/// Power of the whitened residuals: 1 is the noise of the nominal vehicle. The floor is that of simulated missions
/// without a gap; `after` has all that was found in the model, as other missions determined it (every second one
/// of each vehicle).
struct MissionGap {
  double before = 0, after = 0, floor = 0, floor_std = 0;
};

/// All missions of one vehicle together.
struct VehicleAnswer {
  std::string vehicle;
  FleetVerdict verdict = FleetVerdict::no_gap;
  MissionGap gap;
  std::optional<double> closed;  ///< 1 - (after - floor) / (before - floor); empty: no gap before
  std::optional<std::array<double, 2>> closed_ci;  ///< 95 %, bootstrap of the missions
  std::string reason;                              ///< of `unknown`
};

/// What a fleet's missions tell: which causes belong to a vehicle, to the design, to a day, and which began when.
struct FleetAnswer {
  std::vector<FoundCause> causes;      ///< probable enough to be named, and no tolerance
  std::vector<FoundCause> undecided;   ///< there is something, and what or whose is not decided
  std::vector<FoundCause> tolerances;  ///< real, and not larger than what every vehicle has
  std::vector<VehicleAnswer> vehicles;
  std::vector<MissionGap> missions;  ///< in the order of PooledMissions::missions()
  /// Vehicles whose missions were left out of the pool, because more causes would be needed than a vehicle has.
  /// Causes hold their missions as indices into all missions.
  std::vector<std::string> outliers;
};

/// Strength of a cause, typical values: the norm of its parameters without what their errors add to it. And the
/// strength up to which a cause is a tolerance of its level.
[[nodiscard]] double strength_of(const FoundCause& cause);
[[nodiscard]] double tolerance_of(CauseLevel level);

/// Pools the missions of a fleet. `progress` gets 0 to 1.
[[nodiscard]] FleetAnswer answer_of_fleet(const PooledMissions& missions, unsigned threads,
                                          const CauseProgress& progress);

}  // namespace navcal::fleet
