// SPDX-License-Identifier: Apache-2.0
// The separation that a plan predicts against that of simulated recordings of the mission planned.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "config/mission_text.h"
#include "gap/design/planner.h"
#include "gap/inference/biases.h"
#include "gap/inference/subset_evidence.h"
#include "tests/gap/design/observed_separation.h"
#include "tests/gap/design/planned_question.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap::test {
namespace {

struct AchievedCase {
  std::string truth, rival, effects;  ///< effects: TOML of the truth at typical strength

  friend std::ostream& operator<<(std::ostream& out, const AchievedCase& one) {
    return out << one.truth << " for " << one.rival;
  }
};

class AchievedSeparation : public testing::TestWithParam<AchievedCase> {};

TEST_P(AchievedSeparation, IsWithinAQuarterOfThePrediction) {
  const auto& [truth, rival, effects] = GetParam();
  const PlannedQuestion planned({truth, rival});
  const Question question = planned.question();
  const RehearsalProblem problem = planned.problem();
  config::MissionLimits limits;
  limits.duration_s = 150;
  const RehearsedPlan plan =
      Planner(question, ReferenceRehearser(problem), limits, [](std::string_view, double) {}).plan();
  // The strength of the truth is known here, that of the rival is not.
  Hypothesis a = question.hypotheses[0];
  for (const Eigen::Index j : parameter_indices(planned.library(), a.effects)) a.spread.row(j) *= 0.05;
  const Hypothesis& b = question.hypotheses[1];
  const double expected = expected_separation_nats(a, b, plan.all.gram);
  const navcal::test::TemporaryFolder folder;
  const std::string file = (folder.path() / "plan.toml").string();
  std::ofstream(file) << config::mission_text(plan.plan.composed.mission);
  double achieved = 0;
  constexpr int kRecordings = 3;
  for (std::uint64_t seed = 1; seed <= kRecordings; ++seed) {
    const Mission mission = simulated_mission(file, effects, plan.plan.path.duration_s, seed);
    const Replay replay(mission, problem.vehicle);
    Eigen::VectorXd at = with_biases_found(replay, planned.library(), 2);
    for (const Eigen::Index j : parameter_indices(planned.library(), a.effects)) at[j] = a.mean[j];
    const Linearised linear = linearise({replay, planned.library(), problem.whitening, 2}, at);
    achieved += observed_separation_nats(a, b, linear.gram, linear.score + linear.gram * linear.at) / kRecordings;
  }
  std::printf("%s for %s: predicted %.1f nats, achieved %.1f nats, ratio %.2f\n", truth.c_str(), rival.c_str(),
              expected, achieved, achieved / expected);
  EXPECT_NEAR(achieved / expected, 1, 0.25);
}

INSTANTIATE_TEST_SUITE_P(
    OfPairs, AchievedSeparation,
    testing::Values(AchievedCase{"fin_gain", "yaw_damping", "[fin_gain]\nscale = 0.08\n"},
                    AchievedCase{"yaw_damping", "fin_gain", "[yaw_damping]\nper_s = 0.3\n"},
                    AchievedCase{"thrust_scale", "fin_gain", "[thrust_scale]\nscale = 0.08\n"},
                    AchievedCase{
                        "gyro_scale", "fin_gain",
                        "[gyro_scale]\nscale_ax = 0.03\nscale_az = 0.03\nscale_by = 0.03\nscale_bz = 0.03\n"},
                    AchievedCase{"hard_iron", "motor_field", "[hard_iron]\nx_uT = 2\ny_uT = 2\nz_uT = 2\n"},
                    AchievedCase{"motor_field", "hard_iron",
                                 "[motor_field]\nx_uT_per_A = 1\ny_uT_per_A = 1\nz_uT_per_A = 1\n"},
                    AchievedCase{"fin_lag", "imu_latency", "[fin_lag]\ntau_s = 0.2\n"},
                    AchievedCase{"buoyancy", "depth_scale", "[buoyancy]\nforce_N = 0.4\n"}),
    [](const auto& one) { return one.param.truth + "_for_" + one.param.rival; });

}  // namespace
}  // namespace navcal::gap::test
