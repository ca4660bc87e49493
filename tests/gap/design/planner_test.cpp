// SPDX-License-Identifier: Apache-2.0
#include "gap/design/planner.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "config/mission_file.h"
#include "config/mission_text.h"
#include "tests/gap/design/planned_question.h"

namespace navcal::gap::test {
namespace {

const Progress kSilent = [](std::string_view, double) {};

config::MissionLimits limits_of(double minutes) {
  config::MissionLimits limits;
  limits.duration_s = 60 * minutes;
  return limits;
}

/// Gain of fin and damping of yaw, which a straight survey confounds.
const PlannedQuestion& fin_or_damping() {
  static const PlannedQuestion planned({"fin_gain", "yaw_damping"});
  return planned;
}

RehearsedPlan planned(const PlannedQuestion& of, const config::MissionLimits& limits,
                      MissionPurpose purpose = MissionPurpose::separate) {
  const Question question = of.question(purpose);
  const ReferenceRehearser rehearser(of.problem());
  return Planner(question, rehearser, limits, kSilent).plan();
}

TEST(Planner, TellsFinGainFromYawDampingByMovingTheRudder) {
  const RehearsedPlan plan = planned(fin_or_damping(), limits_of(3));
  const auto& steps = plan.plan.composed.mission.steps;
  const auto moves = std::count_if(steps.begin(), steps.end(), [](const config::MissionStep& step) {
    using enum config::StepKind;
    return step.kind == doublet || step.kind == zigzag || step.kind == speed;
  });
  EXPECT_GT(moves, 0);
}

TEST(Planner, StaysWithinTheLimits) {
  config::MissionLimits limits = limits_of(2.5);
  limits.greatest_depth_m = 1.5;
  limits.range_m = 25;
  limits.speed_m_s = 0.9;
  limits.turn_rad_s = 0.4;
  const RehearsedPlan plan = planned(fin_or_damping(), limits);
  const PlannedPath again =
      planned_path({}, config::parse_mission(config::mission_text(plan.plan.composed.mission), "plan.toml"),
                   sim::EffectSet(), 600);
  EXPECT_TRUE(violations(extremes_of(again, limits), limits).empty());
  EXPECT_GE(plan.plan.placed.size(), 1U);
}

TEST(Planner, MoreMinutesNeverSeparateLess) {
  double before = 0;
  for (const double minutes : {1.5, 2.5, 4.0}) {
    const double loss = planned(fin_or_damping(), limits_of(minutes)).loss;
    EXPECT_LE(loss, before) << minutes;
    before = loss;
  }
}

TEST(Planner, VisitsRegimesThatNoRecordingHasSeen) {
  const RehearsedPlan plan = planned(fin_or_damping(), limits_of(4), MissionPurpose::cover);
  const Coverage before = fin_or_damping().question().so_far.coverage;
  EXPECT_GT(newly_covered(before, before + plan.all.coverage).size(), 8U);
}

TEST(Planner, SaysThatNothingFitsTheLimits) {
  config::MissionLimits limits = limits_of(3);
  limits.energy_Wh = 0.1;
  EXPECT_THROW((void)planned(fin_or_damping(), limits), std::invalid_argument);
}

}  // namespace
}  // namespace navcal::gap::test
