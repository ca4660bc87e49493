// SPDX-License-Identifier: Apache-2.0
// Limits come back from their file; every mistake is told with file, line and key. A mission comes back from its
// text.
#include "config/mission_limits.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "config/mission_file.h"
#include "config/mission_text.h"

namespace navcal::config {
namespace {

std::vector<std::string> problems_of_limits(std::string_view toml) {
  try {
    static_cast<void>(parse_mission_limits(toml, "l.toml"));
    return {};
  } catch (const Error& error) {
    return error.problems();
  }
}

TEST(MissionLimits, NothingSaidIsTheDefault) { EXPECT_EQ(parse_mission_limits("", "l.toml"), MissionLimits{}); }

TEST(MissionLimits, TheListedFileIsTheDefault) {
  EXPECT_EQ(parse_mission_limits(mission_limits_file({}), "l.toml"), MissionLimits{});
}

TEST(MissionLimits, TakesUnitsOfTheFile) {
  const MissionLimits limits =
      parse_mission_limits("[limits]\nminutes = 5\nmax_shaft_rpm = 900\nmax_turn_deg_s = 18\n", "l.toml");
  EXPECT_DOUBLE_EQ(limits.duration_s, 300);
  EXPECT_DOUBLE_EQ(limits.shaft_rps, 15);
  EXPECT_NEAR(limits.turn_rad_s, 0.314159, 1e-6);
}

TEST(MissionLimits, TellsEveryMistakeWithItsPlace) {
  struct Case {
    std::string_view toml, place;
  };
  const std::vector<Case> cases{
      {"[limits]\nminutes = 0\n", "l.toml:2: limits.minutes: "},
      {"[limits]\nminutes = \"ten\"\n", "l.toml:2: limits.minutes: "},
      {"[limits]\nminuts = 10\n", "l.toml:2: limits.minuts: "},
      {"[limit]\nminutes = 10\n", "l.toml:1: limit: "},
      {"limits = 3\n", "l.toml:1: limits: "},
      {"[limits]\nmax_speed_m_s = nan\n", "l.toml:2: limits.max_speed_m_s: "},
      {"[limits]\n\nmax_depth_m = 1\nmin_depth_m = 2\n", "l.toml:4: limits.max_depth_m: "},
      {"[limits]\nenergy_Wh = -1\n", "l.toml:2: limits.energy_Wh: "},
      {"[limits\n", "l.toml:1"}};
  for (const auto& [toml, place] : cases) {
    const auto problems = problems_of_limits(toml);
    ASSERT_FALSE(problems.empty()) << toml;
    EXPECT_TRUE(problems.front().starts_with(place)) << problems.front();
  }
}

TEST(MissionText, EveryShippedMissionComesBackFromItsText) {
  for (const ShippedMission& shipped : shipped_missions()) {
    const Mission mission = parse_mission(shipped.toml, shipped.name);
    const std::string text = mission_text(mission, "one\ntwo");
    const Mission again = parse_mission(text, "again.toml");
    EXPECT_TRUE(text.starts_with("# one\n# two\n"));
    ASSERT_EQ(again.steps.size(), mission.steps.size());
    EXPECT_EQ(mission_text(again), mission_text(mission));
    EXPECT_EQ(again.description, mission.description);
    for (std::size_t i = 0; i < mission.steps.size(); ++i) {
      EXPECT_EQ(again.steps[i].kind, mission.steps[i].kind);
      EXPECT_EQ(again.steps[i].times, mission.steps[i].times);
      EXPECT_EQ(again.steps[i].on, mission.steps[i].on);
      EXPECT_NEAR(again.steps[i].shaft_rps.value_or(-1), mission.steps[i].shaft_rps.value_or(-1), 1e-5);
    }
  }
}

}  // namespace
}  // namespace navcal::config
