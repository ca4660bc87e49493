// SPDX-License-Identifier: Apache-2.0
// Missions as they stand in files, and every mistake in them with file, line and reason.
#include "config/mission_file.h"

#include <gtest/gtest.h>

#include "config/mission_options.h"

namespace navcal::config {
namespace {

std::vector<std::string> problems_of_mission(std::string_view toml) {
  try {
    static_cast<void>(parse_mission(toml, "m.toml"));
    return {};
  } catch (const Error& error) {
    return error.problems();
  }
}

using Problems = std::vector<std::string>;

TEST(MissionFile, IsReadInBothFormsOfAnArray) {
  const std::string_view in_tables =
      "[start]\ndepth_m = 2\n[[step]]\ndo = \"leg\"\nheading_deg = 90\nseconds = 3\n"
      "[[step]]\ndo = \"surface\"\nseconds = 4\n";
  const std::string_view in_lines =
      "start.depth_m = 2\nstep = [\n {do = \"leg\", heading_deg = 90, seconds = 3},\n"
      " {do = \"surface\", seconds = 4},\n]\n";
  for (const auto toml : {in_tables, in_lines}) {
    const Mission mission = parse_mission(toml, "m.toml");
    EXPECT_DOUBLE_EQ(mission.start.depth_m, 2);
    ASSERT_EQ(mission.steps.size(), 2U);
    EXPECT_EQ(mission.steps[0].kind, StepKind::leg);
    EXPECT_DOUBLE_EQ(*mission.steps[0].heading_rad, std::numbers::pi / 2);
    EXPECT_EQ(mission.steps[1].kind, StepKind::surface);
    EXPECT_DOUBLE_EQ(*mission.steps[1].seconds, 4);
    EXPECT_GT(mission.steps[1].line, mission.steps[0].line);
  }
}

TEST(MissionFile, ManyStepsStayInOrder) {
  std::string toml;
  for (int i = 1; i <= 123; ++i) toml += "[[step]]\ndo = \"leg\"\nseconds = " + std::to_string(i) + "\n";
  const Mission mission = parse_mission(toml, "m.toml");
  ASSERT_EQ(mission.steps.size(), 123U);
  for (int i = 1; i <= 123; ++i) EXPECT_DOUBLE_EQ(*mission.steps[static_cast<std::size_t>(i - 1)].seconds, i);
}

TEST(MissionFile, MistakesAreNamedByStep) {
  EXPECT_EQ(
      problems_of_mission("[[step]]\ndo = \"leg\"\nseconds = 5\n[[step]]\ndo = \"jump\"\n"),
      Problems{"m.toml:5: step[2].do: unknown do \"jump\"; known: leg, turn, circle, spiral, zigzag, pirouette, "
               "dive, surface, speed, swing, doublet or direct"});
  EXPECT_EQ(problems_of_mission("[[step]]\ndo = \"leg\"\n"),
            Problems{"m.toml:1: step[1]: seconds or metres is missing"});
  EXPECT_EQ(problems_of_mission("[[step]]\ndo = \"leg\"\nseconds = 5\nmetres = 6\n"),
            Problems{"m.toml:1: step[1]: only one of seconds and metres may be given"});
  EXPECT_EQ(
      problems_of_mission("[[step]]\ndo = \"speed\"\nseconds = 5\nshaft_rpm = 600\ndepth_m = 2\n"),
      Problems{"m.toml:5: step[1].depth_m: a speed has no such key; it takes seconds, shaft_rpm, speed_m_s"});
  EXPECT_EQ(problems_of_mission("[[step]]\ndo = \"leg\"\nsecond = 5\nmetres = 3\n"),
            Problems{"m.toml:3: step[1].second: unknown key; did you mean seconds?"});
  EXPECT_EQ(problems_of_mission("[[step]]\ndo = \"dive\"\ndepth_m = -2\n"),
            Problems{"m.toml:3: step[1].depth_m: -2 is out of range: 0 to 1000 m"});
  EXPECT_EQ(problems_of_mission("[[step]]\nseconds = 2\n").front().substr(0, 34),
            "m.toml:1: step[1]: do is missing; ");
}

TEST(MissionFile, MistakesAroundTheSteps) {
  EXPECT_EQ(problems_of_mission(""), Problems{"m.toml:1: step: a mission has a [[step]] or more"});
  EXPECT_EQ(problems_of_mission("[step]\ndo = \"leg\"\n").front(), "m.toml:1: step: tables [[step]] are expected");
  EXPECT_EQ(problems_of_mission("[strat]\n[[step]]\ndo = \"leg\"\nseconds = 1\n"),
            Problems{"m.toml:1: strat: unknown key; did you mean start?"});
  EXPECT_EQ(problems_of_mission("mission.at_end = \"stop\"\n[[step]]\ndo = \"leg\"\nseconds = 1\n"),
            Problems{"m.toml:1: mission.at_end: unknown at_end \"stop\"; known: repeat or hold"});
  EXPECT_EQ(problems_of_mission("[[step]\n").size(), 1U);
}

TEST(MissionFile, EveryKindTakesOnlyKeysThatThereAre) {
  for (std::size_t kind = 0; kind < step_options().front().choices.size(); ++kind) {
    const StepRule& rule = rule_of(static_cast<StepKind>(kind));
    for (const auto* groups : {&rule.required, &rule.optional}) {
      for (const auto& group : *groups) {
        for (const auto key : group) {
          EXPECT_TRUE(std::any_of(step_options().begin(), step_options().end(), [&](const auto& option) {
            return option.key == key;
          })) << key;
        }
      }
    }
  }
}

TEST(MissionFile, TheShippedOnesAreKnownByName) {
  EXPECT_GE(shipped_missions().size(), 11U);
  for (const ShippedMission& shipped : shipped_missions()) {
    const Mission mission = load_mission(std::string(shipped.name));
    EXPECT_FALSE(mission.steps.empty()) << shipped.name;
    EXPECT_FALSE(mission.description.empty()) << shipped.name;
    const std::string file =
        std::string(NAVCAL_SOURCE_DIR) + "/config/missions/" + std::string(shipped.name) + ".toml";
    EXPECT_EQ(load_mission(file).steps.size(), mission.steps.size()) << "what is shipped is what lies there";
  }
  try {
    static_cast<void>(load_mission("surwey"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean survey? (a file has"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(static_cast<void>(load_mission("./nowhere.toml")), Error);
}

}  // namespace
}  // namespace navcal::config
