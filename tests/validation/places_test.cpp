// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "base/world_magnetic_model.h"
#include "validation/missions.h"

namespace navcal::cli {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

TEST(GapTrialPlaces, AreUniformOnTheSphereWithinTheModelsYears) {
  constexpr int kPlaces = 400;
  const double greatest = std::sin(80 / kDegrees);
  double sum = 0, square = 0;
  int western = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const validation::TrialPlace place = validation::drawn_place(5, i);
    const double sine = std::sin(place.anchorage.latitude_deg / kDegrees);
    EXPECT_LE(std::abs(sine), greatest);
    EXPECT_LE(std::abs(place.anchorage.longitude_deg), 180);
    sum += sine;
    square += sine * sine;
    western += place.anchorage.longitude_deg < 0;
    EXPECT_TRUE(base::wmm_covers(base::decimal_year(place.begin_ns + 3 * 86'400'000'000'000)));
    EXPECT_GE(place.waters.surface_C, 2);
    EXPECT_LE(place.waters.surface_C, 28);
    EXPECT_GE(place.waters.density_kg_m3, 998);
    EXPECT_LE(place.waters.density_kg_m3, 1028);
  }
  EXPECT_NEAR(sum / kPlaces, 0, 4 * greatest / std::sqrt(3.0 * kPlaces));
  EXPECT_NEAR(square / kPlaces, greatest * greatest / 3, 0.06);
  EXPECT_NEAR(western, kPlaces / 2, 40);
}

TEST(GapTrialPlaces, HaveTheModelsFieldAndComeAgainWithTheirSeed) {
  const validation::TrialPlace place = validation::drawn_place(7, 3);
  const auto there = base::world_magnetic_field(
      {place.anchorage.latitude_deg / kDegrees, place.anchorage.longitude_deg / kDegrees, 0},
      base::decimal_year(place.begin_ns));
  EXPECT_EQ(place.waters.field_uT, there.north_east_down_uT);
  EXPECT_EQ(validation::drawn_place(7, 3).anchorage.latitude_deg, place.anchorage.latitude_deg);
  EXPECT_NE(validation::drawn_place(7, 4).anchorage.latitude_deg, place.anchorage.latitude_deg);
  EXPECT_NE(validation::drawn_place(8, 3).anchorage.latitude_deg, place.anchorage.latitude_deg);
}

TEST(GapTrialPlaces, MissionsThereAreTheSameMissions) {
  const validation::TrialPlace place = validation::drawn_place(7, 3);
  const auto missions = validation::trial_missions(validation::MissionKind::brief, 3);
  const reference::Mission first = validation::at_place(missions[0], place),
                           second = validation::at_place(missions[1], place);
  EXPECT_EQ(first.start_ns, place.begin_ns);
  EXPECT_EQ(second.start_ns - first.start_ns, missions[1].start_ns - missions[0].start_ns);
  EXPECT_EQ(first.orders.size(), missions[0].orders.size());
  EXPECT_EQ(first.anchorage.longitude_deg, place.anchorage.longitude_deg);
  EXPECT_EQ(first.waters.field_uT, place.waters.field_uT);
}

}  // namespace
}  // namespace navcal::cli
