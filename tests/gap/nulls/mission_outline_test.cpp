// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/mission_outline.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

TEST(MissionOutline, MissionsSteeredAlikeAreAlikeWhateverTheirNoiseAndEffects) {
  const MissionOutline first = outline_of(test::simulated_mission("identification", "", 60, 1));
  ASSERT_EQ(first.features.size(), 20U) << "five whole windows: the last reading comes before 60 s";
  EXPECT_TRUE(are_alike(first, first));
  EXPECT_TRUE(are_alike(first, outline_of(test::simulated_mission("identification", "", 60, 2))));
  EXPECT_TRUE(
      are_alike(first, outline_of(test::simulated_mission("identification", "[hard_iron]\nx_uT = 2\n", 60, 9))));
  EXPECT_FALSE(are_alike(first, outline_of(test::simulated_mission("thesis1", "", 60, 1))));
  EXPECT_FALSE(are_alike(first, outline_of(test::simulated_mission("identification", "", 120, 1))));
}

TEST(MissionOutline, OtherInstrumentsAndAnotherFieldAreNotAlike) {
  const MissionOutline first = outline_of(test::simulated_mission("identification", "", 60, 1));
  devices::InstrumentModel noisier;
  noisier.compass.field_noise_uT *= 1.01;
  Mission mission = test::simulated_mission("identification", "", 60, 1);
  mission.instruments = noisier;
  EXPECT_FALSE(are_alike(first, outline_of(mission)));
  MissionOutline elsewhere = first;
  elsewhere.field_uT[2] += 0.6;
  EXPECT_FALSE(are_alike(first, elsewhere));
  elsewhere.field_uT[2] -= 0.4;
  EXPECT_TRUE(are_alike(first, elsewhere));
  elsewhere.field_is_fitted = !elsewhere.field_is_fitted;
  EXPECT_FALSE(are_alike(first, elsewhere));
}

TEST(MissionOutline, AMissionThatCannotBeDiagnosedHasNoneAndIsLikeNoOther) {
  const MissionOutline none = outline_of(Mission{});
  EXPECT_TRUE(none.features.empty());
  EXPECT_FALSE(are_alike(none, none));
}

TEST(FingerprintDistance, IsInfiniteBetweenDifferentLengthsAndZeroToItself) {
  const std::vector<double> a(40, 1.0), b(44, 1.0), c(60, 1.0), d(40, 3.0);
  EXPECT_EQ(fingerprint_distance(a, a), 0);
  EXPECT_EQ(fingerprint_distance(a, b), 0);
  EXPECT_EQ(fingerprint_distance(a, c), std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(fingerprint_distance(a, d), 2);
  EXPECT_EQ(fingerprint_distance({}, {}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace navcal::gap
