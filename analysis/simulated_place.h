// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "analysis/place_arguments.h"
#include "sim/geodesy.h"
#include "sim/state.h"

namespace navcal::analysis {

/// Place and field of a simulated vehicle.
struct SimulatedPlace {
  sim::Origin origin;
  sim::Vector3 field_world_uT =
      sim::State{}.field_world_uT;  ///< north, east, down; by default the reference field

  std::string remark = {};  ///< that the model was extrapolated to the date; empty: it was not

  /// The field as an `#event` line of a recording.
  [[nodiscard]] std::string field_event() const;
};

/// Place of the arguments; the model's field is that of --date, or of `otherwise_ns` (UTC) without it. Throws
/// Failure for invalid arguments, and beyond 89 degrees of latitude, where the simulator's flat map ends.
[[nodiscard]] SimulatedPlace simulated_place(const PlaceArguments& arguments, std::int64_t otherwise_ns);

/// Place of emulated instruments at `now_ns` (UTC). Without a stated field it has the model's field, also at the
/// simulator's own place, because a navcald that listens computes the model's field at the fixes.
[[nodiscard]] SimulatedPlace emulated_place(const PlaceArguments& arguments, std::int64_t now_ns);

}  // namespace navcal::analysis
