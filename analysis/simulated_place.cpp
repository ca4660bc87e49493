// SPDX-License-Identifier: Apache-2.0
#include "analysis/simulated_place.h"

#include <fmt/format.h>

#include <cmath>

#include "analysis/failure.h"
#include "base/angles.h"

namespace navcal::analysis {

std::string SimulatedPlace::field_event() const {
  return "event simulated field of the Earth: " + field_text(field_world_uT);
}

SimulatedPlace simulated_place(const PlaceArguments& arguments, std::int64_t otherwise_ns) {
  constexpr double kGreatestLatitude_deg = 89;
  SimulatedPlace place;
  if (const auto position = arguments.position()) {
    place.origin = {position->latitude_rad * base::kDegreesPerRadian,
                    std::remainder(position->longitude_rad * base::kDegreesPerRadian, 360), position->height_m};
    if (!(std::abs(place.origin.latitude_deg) <= kGreatestLatitude_deg)) {
      throw Failure(Exit::usage, fmt::format("--place {}: a simulated vehicle stays within 89 degrees of latitude",
                                             *arguments.place));
    }
  }
  if (arguments.place && !arguments.field)
    place.remark = extrapolation_remark(model_year(arguments, otherwise_ns));
  place.field_world_uT = chosen_field_uT(arguments, otherwise_ns).value_or(place.field_world_uT);
  return place;
}

SimulatedPlace emulated_place(const PlaceArguments& arguments, std::int64_t now_ns) {
  PlaceArguments where = arguments;
  if (!where.place) {
    constexpr sim::Origin kHome;
    where.place = fmt::format("{},{},{}", kHome.latitude_deg, kHome.longitude_deg, kHome.height_m);
  }
  return simulated_place(where, now_ns);
}

}  // namespace navcal::analysis
