// SPDX-License-Identifier: Apache-2.0
// A mission planned after a short recording, against a small bank.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "config/mission_file.h"
#include "gap/design/mission_design.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap {
namespace {

class PlanNextMission : public testing::Test {
 protected:
  NextMission planned(std::string_view effects, const config::MissionLimits& limits) {
    test::write_mission(folder_ / "a.cap", "survey", effects, 100, 3);
    Request request;
    request.missions = {folder_ / "a.cap"};
    request.cache = folder_ / "banks";
    request.bank_missions = 15;
    return next_mission(request, limits, [](std::string_view, double) {});
  }
  navcal::test::TemporaryFolder folder_;
};

TEST_F(PlanNextMission, KeepsToTheLimitsAndRuns) {
  config::MissionLimits limits;
  limits.duration_s = 120;
  limits.greatest_depth_m = 1.5;
  limits.radius_m = 60;
  const NextMission next = planned("[yaw_damping]\nper_s = 0.06\n", limits);
  ASSERT_FALSE(next.toml.empty()) << next.sentence;
  EXPECT_LE(next.duration_s, limits.duration_s);
  EXPECT_FALSE(next.manoeuvres.empty());
  EXPECT_FALSE(next.sentence.empty());
  EXPECT_GT(next.energy_J, 0);
  ASSERT_FALSE(next.track.empty());
  for (const PlannedInstant& now : next.track) {
    EXPECT_LE(now.depth_m, limits.greatest_depth_m);
    EXPECT_LE(std::hypot(now.north_m, now.east_m), limits.radius_m);
  }
  EXPECT_GT(config::parse_mission(next.toml, "next.toml").steps.size(), 2U);
  EXPECT_TRUE(std::is_sorted(
      next.pairs.begin(), next.pairs.end(),
      [](const SeparatedPair& a, const SeparatedPair& b) { return a.separation_nats < b.separation_nats; }));
}

TEST_F(PlanNextMission, TestsWeakEffectsWhereNothingIsSeen) {
  config::MissionLimits limits;
  limits.duration_s = 90;
  const NextMission next = planned("", limits);
  EXPECT_EQ(next.diagnosis.verdict, Verdict::no_gap);
  EXPECT_EQ(next.purpose, DesignPurpose::test);
  EXPECT_NE(next.sentence.find("no gap"), std::string::npos);
  for (const SeparatedPair& pair : next.pairs) EXPECT_TRUE(pair.a.empty());
}

}  // namespace
}  // namespace navcal::gap
