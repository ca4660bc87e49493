// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/world_magnetic_model.h"

namespace navcal::analysis {

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

/// The field that --field states; else the model's at --place on --date, or at `otherwise_ns` (UTC) without a
/// date; else none. Says to standard error when the model does not cover that time.
[[nodiscard]] std::optional<std::array<double, 3>> chosen_field_uT(const PlaceArguments& arguments,
                                                                   std::int64_t otherwise_ns);

/// Warns on standard error when the model is extrapolated to that year.
void warn_if_extrapolated(double year);

/// "north 19.000, east 0.600, down 44.000 uT".
[[nodiscard]] std::string field_text(const std::array<double, 3>& field_uT);

}  // namespace navcal::analysis
