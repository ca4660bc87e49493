// SPDX-License-Identifier: Apache-2.0
#include "validation/places.h"

#include <cmath>

#include "base/angles.h"
#include "base/world_magnetic_model.h"
#include "validation/missions.h"
#include "validation/reference/rng.h"

namespace navcal::validation {

TrialPlace drawn_place(std::uint64_t seed, int number) {
  constexpr double kGreatestLatitude_deg = 80;
  /// Apart from the cases and their orders of drawing.
  constexpr std::uint64_t kPlaceStream = 1ULL << 40U;
  constexpr std::int64_t kFrom_ns = 20'089 * kDay_ns, kUntil_ns = 21'910 * kDay_ns;  // 2025-01-01, 2029-12-27
  reference::Rng dice(seed, kPlaceStream + static_cast<std::uint64_t>(number));
  TrialPlace place;
  const double sine = std::sin(kGreatestLatitude_deg / base::kDegreesPerRadian);
  place.anchorage = {std::asin(dice.uniform(-sine, sine)) * base::kDegreesPerRadian, dice.uniform(-180, 180), 0};
  const auto day = static_cast<std::int64_t>(
      dice.uniform(static_cast<double>(kFrom_ns / kDay_ns), static_cast<double>(kUntil_ns / kDay_ns)));
  place.begin_ns = day * kDay_ns + kTrialBegin_ns % kDay_ns;
  place.waters.surface_C = dice.uniform(2, 28);
  place.waters.density_kg_m3 = dice.uniform(998, 1028);
  place.waters.field_uT = base::world_magnetic_field(
                              {place.anchorage.latitude_deg / base::kDegreesPerRadian,
                               place.anchorage.longitude_deg / base::kDegreesPerRadian, place.anchorage.height_m},
                              base::decimal_year(place.begin_ns))
                              .north_east_down_uT;
  return place;
}

reference::Mission at_place(reference::Mission mission, const TrialPlace& place) {
  mission.anchorage = place.anchorage;
  mission.waters = place.waters;
  mission.start_ns += place.begin_ns - kTrialBegin_ns;
  return mission;
}

}  // namespace navcal::validation
