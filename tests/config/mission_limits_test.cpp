// SPDX-License-Identifier: Apache-2.0
#include "config/mission_limits.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace navcal::config {
namespace {

TEST(MissionLimits, HaveDefaultsForWhatTheFileDoesNotSay) {
  EXPECT_EQ(parse_mission_limits("", "l.toml"), MissionLimits{});
}

TEST(MissionLimits, AreReadInSI) {
  const MissionLimits limits = parse_mission_limits(
      "minutes = 4\nleast_depth_m = 0.5\ngreatest_depth_m = 6\nradius_m = 40\nleast_shaft_rpm = 300\n"
      "greatest_shaft_rpm = 900\ngreatest_turn_rate_deg_s = 18\ngreatest_pitch_deg = 30\nenergy_Wh = 2\nbattery_V "
      "= 24\n",
      "l.toml");
  EXPECT_EQ(limits.duration_s, 240);
  EXPECT_EQ(limits.greatest_shaft_rps, 15);
  EXPECT_NEAR(limits.greatest_turn_rate_rad_s, std::numbers::pi / 10, 1e-12);
  EXPECT_EQ(limits.energy_J, 7200);
}

TEST(MissionLimits, NameFileLineAndKeyOfEachProblem) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"minuts = 3", "l.toml:1: minuts: unknown key; did you mean minutes?"},
      {"minutes = \"3\"", "l.toml:1: minutes: a number from 0.5 to 120"},
      {"\nminutes = 500", "l.toml:2: minutes:"},
      {"radius_m = nan", "l.toml:1: radius_m:"},
      {"least_depth_m = 5", "greatest_depth_m: must be more than least_depth_m"},
      {"least_shaft_rpm = 2000", "greatest_shaft_rpm: must be more than least_shaft_rpm"},
      {"[table]\nminutes = 3", "table"},
      {"minutes = ", "l.toml:1"}};
  for (const auto& [toml, message] : wrong) {
    try {
      (void)parse_mission_limits(toml, "l.toml");
      ADD_FAILURE() << toml;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace navcal::config
