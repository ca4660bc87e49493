// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/world_magnetic_model.h"
#include "sim/geodesy.h"
#include "sim/state.h"

namespace navcal::emulation {

/// --place, --date and --field as they were given. The functions throw Failure for what cannot be read.
struct PlaceArguments {
  std::optional<std::string> place, date, field;

  /// LAT,LON or LAT,LON,HEIGHT_M in degrees and metres.
  [[nodiscard]] std::optional<base::GeodeticPosition> position() const;
  /// 00:00 UTC of the day, nanoseconds since the epoch.
  [[nodiscard]] std::optional<std::int64_t> day_ns() const;
  /// North, east, down.
  [[nodiscard]] std::optional<std::array<double, 3>> field_uT() const;
};

/// Year for which the World Magnetic Model is asked: that of --date, or of `otherwise_ns` (UTC) without a date.
[[nodiscard]] double model_year(const PlaceArguments& arguments, std::int64_t otherwise_ns);

/// The field that --field states; else the model's at --place in model_year(); else none.
[[nodiscard]] std::optional<std::array<double, 3>> chosen_field_uT(const PlaceArguments& arguments,
                                                                   std::int64_t otherwise_ns);

/// Says that the model is extrapolated to that year; empty where it covers the year.
[[nodiscard]] std::string extrapolation_remark(double year);

/// Writes extrapolation_remark() to standard error, if there is one.
void warn_if_extrapolated(double year);

/// "north 19.000, east 0.600, down 44.000 uT".
[[nodiscard]] std::string field_text(const std::array<double, 3>& field_uT);

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

}  // namespace navcal::emulation
