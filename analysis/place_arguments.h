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

}  // namespace navcal::analysis
