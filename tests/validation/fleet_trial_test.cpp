// SPDX-License-Identifier: Apache-2.0
#include "bench/fleet_trial/fleet_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace navcal::bench {
namespace {

FleetTruth truth_of(const FleetCase& fleet) { return read_fleet_truth(truth_text(fleet)); }

TEST(FleetCases, AreTheSameForTheSameSeed) {
  FleetTrialOptions options;
  options.seed = 4;
  EXPECT_EQ(truth_text(drawn_fleet(options)), truth_text(drawn_fleet(options)));
  options.seed = 5;
  EXPECT_NE(truth_text(drawn_fleet(options)), truth_text(drawn_fleet({})));
}

TEST(FleetCases, HaveCausesOfEachLevel) {
  const FleetTruth truth = truth_of(drawn_fleet({}));
  for (const FleetLevel level : {FleetLevel::vehicle, FleetLevel::design, FleetLevel::day}) {
    EXPECT_TRUE(std::any_of(truth.causes.begin(), truth.causes.end(), [&](const FleetCause& cause) {
      return cause.level == level;
    })) << name_of(level);
  }
  EXPECT_TRUE(std::any_of(truth.causes.begin(), truth.causes.end(),
                          [](const FleetCause& cause) { return cause.is_foreign; }));
}

TEST(FleetCases, ActFromTheirDayOn) {
  const FleetCause cause{FleetLevel::vehicle, 2, 4, 1, false, {}};
  EXPECT_FALSE(cause.acts_in(2, 3));
  EXPECT_TRUE(cause.acts_in(2, 4));
  EXPECT_FALSE(cause.acts_in(3, 4));
}

TEST(FleetScore, CountsRightWrongUndecidedAndMissed) {
  FleetTruth truth;
  truth.causes = {{FleetLevel::vehicle, 1, 1, 0.2, false, {"fin_gain", {{"scale", 0.02}}}},
                  {FleetLevel::vehicle, 2, 4, 0.2, false, {"hard_iron", {}}},
                  {FleetLevel::design, 0, 0, 0.2, false, {"soft_iron", {}}},
                  {FleetLevel::vehicle, 3, 1, 1, true, {"tether", {}}}};
  const FleetScore score = score_of(truth, R"({"causes":[
    {"name":"fin_gain","level":"vehicle","of":"v01","since":null,"parameters":{"scale":0.021},"std_errors":{"scale":0.001}},
    {"name":"soft_iron","level":"vehicle","of":"v05","since":null,"parameters":{},"std_errors":{}}],
    "undecided":[{"name":"gyro_scale","level":"vehicle","of":"v02","alternatives":[{"name":"hard_iron","level":"vehicle","of":"v02"}]}],
    "vehicles":[{"vehicle":"v01","verdict":"explained"},{"vehicle":"v03","verdict":"unknown"}]})");
  EXPECT_EQ(score.causes.at("vehicle").at("right"), 1);
  EXPECT_EQ(score.causes.at("vehicle, begins").at("undecided"), 1);
  EXPECT_EQ(score.causes.at("design").at("wrong level"), 1);
  EXPECT_EQ(score.named, 2);
  EXPECT_EQ(score.named_wrong, 1);
  EXPECT_EQ(score.foreign_unknown, 1);
  EXPECT_EQ(score.parameters_within_two, 1);
  EXPECT_NE(score_text(score).find("wrong level"), std::string::npos);
}

TEST(FleetScore, RefusesWhatIsNoAnswer) {
  EXPECT_THROW((void)score_of({}, "{}"), std::runtime_error);
  EXPECT_THROW((void)score_of({}, "no JSON"), std::runtime_error);
  EXPECT_THROW((void)read_fleet_truth("[]"), std::runtime_error);
}

}  // namespace
}  // namespace navcal::bench
