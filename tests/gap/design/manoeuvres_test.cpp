// SPDX-License-Identifier: Apache-2.0
#include "gap/design/manoeuvres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "config/mission_file.h"

namespace navcal::gap {
namespace {

TEST(ManoeuvreAlphabet, IsWrittenInTheWordsOfAMissionFile) {
  const config::MissionLimits limits;
  const auto alphabet = manoeuvre_alphabet(limits);
  EXPECT_GT(alphabet.size(), 25U);
  for (const ManoeuvreChoice& choice : alphabet) {
    SCOPED_TRACE(choice.name);
    const config::Mission mission = config::parse_mission(mission_file_of({&choice}, limits, "one"), "plan.toml");
    EXPECT_EQ(mission.at_end, config::MissionEnd::hold);
    EXPECT_GT(mission.steps.size(), 1U);
  }
}

TEST(ManoeuvreAlphabet, KeepsToTheLimits) {
  config::MissionLimits limits;
  limits.least_depth_m = 1;
  limits.greatest_depth_m = 2;
  limits.greatest_shaft_rps = 12;
  limits.greatest_turn_rate_rad_s = 0.25;
  for (const ManoeuvreChoice& choice : manoeuvre_alphabet(limits)) {
    SCOPED_TRACE(choice.name);
    for (const config::MissionStep& step :
         config::parse_mission(mission_file_of({&choice}, limits, "one"), "plan.toml").steps) {
      if (step.depth_m) {
        EXPECT_GE(*step.depth_m, limits.least_depth_m);
        EXPECT_LE(*step.depth_m, limits.greatest_depth_m);
      }
      EXPECT_LE(step.shaft_rps.value_or(0), limits.greatest_shaft_rps + 0.01);
      EXPECT_LE(std::abs(step.rate_rad_s.value_or(0)), limits.greatest_turn_rate_rad_s);
      EXPECT_NE(step.kind, config::StepKind::surface) << "no surface within the limits";
    }
  }
}

TEST(ManoeuvreAlphabet, MovesEachActuatorByItself) {
  const auto alphabet = manoeuvre_alphabet({});
  for (const char* what :
       {"fin 1", "fin 2", "fin 3", "rudder doublets", "elevator doublets", "steps of speed", "rest"}) {
    EXPECT_TRUE(std::any_of(alphabet.begin(), alphabet.end(), [&](const ManoeuvreChoice& choice) {
      return choice.name.find(what) != std::string::npos;
    })) << what;
  }
}

}  // namespace
}  // namespace navcal::gap
