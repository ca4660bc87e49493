// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "analysis/place_arguments.h"
#include "sim/geodesy.h"
#include "sim/state.h"

namespace navcal::analysis {

/// Where a simulated vehicle is.
struct SimulatedPlace {
  sim::Origin origin;
  sim::Vector3 field_world_uT =
      sim::State{}.field_world_uT;  ///< north, east, down; by default the reference field

  /// What a recording says of it, as an `#event` line.
  [[nodiscard]] std::string field_event() const;
};

/// What the arguments say; the model's field is that of --date, or of `otherwise_ns` (UTC) without it. Throws
/// Failure for what cannot be read, and beyond 89 degrees of latitude, where the simulator's flat map ends.
[[nodiscard]] SimulatedPlace simulated_place(const PlaceArguments& arguments, std::int64_t otherwise_ns);

/// Where emulated instruments are at `now_ns` (UTC). Without a field the model's at the place counts, also at the
/// simulator's own place: a navcald that listens looks it up at the fixes.
[[nodiscard]] SimulatedPlace emulated_place(const PlaceArguments& arguments, std::int64_t now_ns);

}  // namespace navcal::analysis
