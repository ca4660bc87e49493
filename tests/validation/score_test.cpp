// SPDX-License-Identifier: Apache-2.0
#include "validation/score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <tuple>

#include "tests/validation/made_up_answers.h"
#include "validation/confusion.h"
#include "validation/layout_cases.h"

namespace navcal::cli {
namespace {

using test::answered;
using test::made_up_case;
using test::named;
using test::verdict;

validation::TrialScore score_named(const validation::TrialScores& scores, const std::string& name) {
  const auto found =
      std::find_if(scores.scores.begin(), scores.scores.end(), [&](const auto& s) { return s.name == name; });
  EXPECT_NE(found, scores.scores.end()) << name;
  return found == scores.scores.end() ? validation::TrialScore{} : *found;
}

TEST(GapTrialScore, WilsonAndQuantilesAreThoseOfTheBooks) {
  // Newcombe, Statistics in Medicine 17 (1998), table I: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
  const auto expect = [](int hits, int cases, double low, double high) {
    EXPECT_NEAR(validation::wilson(hits, cases)[0], low, 5e-5);
    EXPECT_NEAR(validation::wilson(hits, cases)[1], high, 5e-5);
  };
  expect(81, 263, 0.2553, 0.3662);
  expect(15, 148, 0.0624, 0.1605);
  expect(0, 20, 0.0, 0.1611);
  expect(1, 29, 0.0061, 0.1718);
  EXPECT_EQ(validation::wilson(0, 0), (std::array{0.0, 1.0}));
  EXPECT_EQ(validation::quantile({}, 0.5), std::nullopt);
  EXPECT_EQ(validation::quantile({3, 1, 2}, 0.5), 2);
  EXPECT_DOUBLE_EQ(*validation::quantile({0, 10}, 0.1), 1);
}

TEST(GapTrialScore, ATargetIsMetBetweenItsBounds) {
  validation::TrialScore score;
  EXPECT_FALSE(score.met());
  score.least = 0.9;
  EXPECT_FALSE(score.met());
  score.value = 0.9;
  EXPECT_EQ(score.met(), true);
  score.most = 0.98;
  score.value = 0.99;
  EXPECT_EQ(score.met(), false);
}

TEST(GapTrialScore, NullsThatAreFlaggedAndNamedAreCountedApart) {
  std::vector<validation::TrialResult> results;
  const validation::TrialCase null = made_up_case(validation::TrialArm::nulls, {});
  for (int i = 0; i < 7; ++i) results.push_back(answered(null, verdict(validation::TrialVerdict::no_gap)));
  results.push_back(answered(null, verdict(validation::TrialVerdict::unknown)));
  results.push_back(answered(null, named({"fin_lag"})));
  results.push_back({});
  results.back().drawn = null;
  results.push_back(
      answered(made_up_case(validation::TrialArm::nulls_6, {}), verdict(validation::TrialVerdict::unknown)));
  const validation::TrialScores scores = validation::trial_scores(results);
  const validation::TrialScore flagged = score_named(scores, "nulls: flagged");
  EXPECT_EQ(flagged.hits, 2);
  EXPECT_EQ(flagged.cases, 10);
  EXPECT_EQ(flagged.met(), false);
  EXPECT_EQ(score_named(scores, "nulls: an effect named").hits, 1);
  EXPECT_EQ(score_named(scores, "nulls-6: an effect named").hits, 0);
  EXPECT_EQ(score_named(scores, "no answer").hits, 1);
  EXPECT_EQ(score_named(scores, "no answer").met(), false);
}

TEST(GapTrialScore, SinglesExactTopWrongUnknownAndConsidered) {
  const validation::TrialCase drawn = made_up_case(validation::TrialArm::single, {"motor_field"});
  validation::TrialAnswer considered = verdict(validation::TrialVerdict::unknown);
  considered.candidates = {{"hard_iron", 0.6, {}}, {"motor_field", 0.4, {}}};
  validation::TrialAnswer twin = named({"hard_iron"});
  twin.twins = {"motor_field"};
  const std::vector<validation::TrialResult> results{answered(drawn, named({"motor_field"})),
                                                     answered(drawn, considered), answered(drawn, twin),
                                                     answered(drawn, named({"motor_field", "fin_lag"})),
                                                     answered(drawn, verdict(validation::TrialVerdict::no_gap))};
  const validation::TrialScores scores = validation::trial_scores(results);
  const auto hits = [&](const char* name) { return score_named(scores, name).hits; };
  EXPECT_EQ(hits("single-1: exact"), 1);
  EXPECT_EQ(hits("single-1: wrong name"), 2);
  EXPECT_EQ(hits("single-1: unknown"), 1);
  EXPECT_EQ(hits("single-1: most probable right"), 2);
  EXPECT_EQ(hits("single-1: truth considered"), 4);
  const validation::TrialScore of_named = score_named(scores, "single-1: exact of those named");
  EXPECT_EQ(of_named.hits, 1);
  EXPECT_EQ(of_named.cases, 3);
  EXPECT_EQ(scores.power.at(3).hits, 1);
  EXPECT_EQ(scores.power.at(3).cases, 5);
}

TEST(GapTrialScore, SetsMustBeWholeAndWhatIsLeftOutIsNotWrong) {
  const validation::TrialCase pair = made_up_case(validation::TrialArm::pairs, {"fin_gain", "fin_lag"});
  EXPECT_EQ(validation::judged(answered(pair, named({"fin_lag", "fin_gain"}))).outcome,
            validation::TrialOutcome::exact);
  EXPECT_EQ(validation::judged(answered(pair, named({"fin_lag"}))).outcome, validation::TrialOutcome::part);
  EXPECT_EQ(validation::judged(answered(pair, named({"fin_lag", "yaw_damping"}))).outcome,
            validation::TrialOutcome::wrong);
}

TEST(GapTrialScore, RemovedMayBeUnknownOrItsClassAndForeignOnlyUnknown) {
  const validation::TrialCase removed = made_up_case(validation::TrialArm::removed, {"fin_gain"});
  for (const auto& [answer, outcome, right] :
       {std::tuple{verdict(validation::TrialVerdict::unknown), validation::TrialOutcome::unknown, true},
        {named({"yaw_damping", "thrust_scale"}), validation::TrialOutcome::in_class, true},
        {named({"yaw_damping", "hard_iron"}), validation::TrialOutcome::wrong, false},
        {verdict(validation::TrialVerdict::no_gap), validation::TrialOutcome::no_gap, false}}) {
    EXPECT_EQ(validation::judged(answered(removed, answer)).outcome, outcome);
    EXPECT_EQ(validation::judged(answered(removed, answer)).right, right);
  }
  const validation::TrialCase foreign = made_up_case(validation::TrialArm::foreign, {"fouling"});
  EXPECT_TRUE(validation::judged(answered(foreign, verdict(validation::TrialVerdict::unknown))).right);
  EXPECT_EQ(validation::judged(answered(foreign, named({"thrust_scale"}))).outcome,
            validation::TrialOutcome::wrong);
}

TEST(GapTrialScore, PoorMissionsWantNoWrongNameAndTheTruthAmongTheTwins) {
  const validation::TrialCase poor = made_up_case(validation::TrialArm::poor, {"fin_gain"});
  validation::TrialAnswer twins = verdict(validation::TrialVerdict::unknown);
  EXPECT_FALSE(validation::judged(answered(poor, twins)).right);
  twins.candidates = {{"yaw_damping", 0.5, {}}};
  twins.twins = {"fin_gain"};
  EXPECT_TRUE(validation::judged(answered(poor, twins)).right);
}

TEST(GapTrialScore, ParametersAreHeldAgainstTheTruthWithItsTolerance) {
  validation::TrialCase drawn = made_up_case(validation::TrialArm::single, {"motor_field"});
  drawn.effects[0].real["y_uT_per_A"] = 0.03;  // the tolerance
  validation::TrialAnswer answer = named({"motor_field"});
  answer.effects[0].parameters = {
      {"x_uT_per_A", {1.19, 0.1}}, {"y_uT_per_A", {0.0, 0.01}}, {"z_uT_per_A", {0.0, std::nullopt}}};
  const validation::TrialJudgement judgement = validation::judged(answered(drawn, answer));
  EXPECT_EQ(judgement.parameters, 3);
  EXPECT_EQ(judgement.parameters_within, 1);  // y is three errors away, z has none
}

TEST(GapTrialScore, ClosureIsThatOfExactOutcomesAndItsIntervalHoldsOne) {
  const validation::TrialCase drawn = made_up_case(validation::TrialArm::single, {"motor_field"});
  std::vector<validation::TrialResult> results;
  for (const double closed : {0.9, 0.98, 1.0}) {
    validation::TrialAnswer answer = named({"motor_field"});
    answer.closed = closed;
    answer.closed_ci = {closed - 0.03, closed + 0.03};
    results.push_back(answered(drawn, answer));
  }
  validation::TrialAnswer wrong = named({"hard_iron"});
  wrong.closed = 0.2;
  results.push_back(answered(drawn, wrong));
  const validation::TrialScores scores = validation::trial_scores(results);
  EXPECT_DOUBLE_EQ(*score_named(scores, "closure: median").value, 0.98);
  EXPECT_DOUBLE_EQ(*score_named(scores, "closure: 10th percentile").value, 0.9 + 0.2 * 0.08);
  EXPECT_EQ(score_named(scores, "closure: the interval holds the truth").hits, 2);
  EXPECT_EQ(score_named(scores, "closure: the interval holds the truth").cases, 3);
}

TEST(GapTrialScore, TheStrongestChannelMustBeOneWhereAnEffectCanShow) {
  const validation::TrialCase drawn = made_up_case(validation::TrialArm::single, {"motor_field"});
  for (const auto& [channel, right] : {std::pair{"compass.field", true}, {"imu.depth", false}}) {
    validation::TrialAnswer answer = verdict(validation::TrialVerdict::unknown);
    answer.channels = {channel, "compass.field"};
    EXPECT_EQ(validation::judged(answered(drawn, answer)).channel_right, right);
  }
  EXPECT_EQ(validation::judged(answered(drawn, verdict(validation::TrialVerdict::unknown))).channel_right, false);
  EXPECT_EQ(validation::judged(answered(drawn, verdict(validation::TrialVerdict::no_gap))).channel_right,
            std::nullopt);
}

// A sloshing inclinometer shows in the gyros: a channel in which it may show, and not where it enters.
TEST(GapTrialScore, TheFirstSourceMustBeWhereAnEffectEnters) {
  const validation::TrialCase drawn = made_up_case(validation::TrialArm::single, {"tilt_slosh"});
  for (const auto& [source, right] : {std::pair{"compass.tilt", true}, {"imu.gyro", false}}) {
    validation::TrialAnswer answer = verdict(validation::TrialVerdict::unknown);
    answer.channels = {"imu.gyro"};
    answer.sources = {source, "compass.tilt"};
    EXPECT_EQ(validation::judged(answered(drawn, answer)).source_right, right);
    EXPECT_EQ(validation::judged(answered(drawn, answer)).channel_right, true);
    EXPECT_EQ(validation::judged(answered(drawn, answer)).family_right, std::nullopt);
  }
  EXPECT_EQ(validation::judged(answered(drawn, verdict(validation::TrialVerdict::unknown))).source_right, false);
}

TEST(GapTrialScore, TheProposalOfAForeignEffectMustFollowItsQuantity) {
  const validation::TrialCase drawn = made_up_case(validation::TrialArm::foreign, {"gps_multipath"});
  for (const auto& [family, right] : {std::pair{"heading", true}, {"depth", false}}) {
    validation::TrialAnswer answer = verdict(validation::TrialVerdict::unknown);
    answer.families = {family};
    EXPECT_EQ(validation::judged(answered(drawn, answer)).family_right, right);
  }
  EXPECT_EQ(validation::judged(answered(drawn, verdict(validation::TrialVerdict::unknown))).family_right, false);
  // An effect of the library that the diagnosis has to do without has no such quantity to be held against.
  const validation::TrialCase removed = made_up_case(validation::TrialArm::removed, {"gyro_scale"});
  EXPECT_EQ(validation::judged(answered(removed, verdict(validation::TrialVerdict::unknown))).family_right,
            std::nullopt);
}

TEST(GapTrialScore, CalibrationErrorIsTheMeanDistanceByBets) {
  const validation::TrialCase drawn = made_up_case(validation::TrialArm::single, {"motor_field"});
  validation::TrialAnswer right = named({"motor_field"}, 0.8);
  right.candidates = {{"hard_iron", 0.2, {}}, {"fin_lag", 0.01, {}}, {"motor_field", 0.8, {}}};
  const std::vector<validation::TrialResult> results{answered(drawn, right),
                                                     answered(drawn, named({"hard_iron"}, 0.84))};
  const validation::TrialScores scores = validation::trial_scores(results);
  EXPECT_EQ(scores.calibration[8].bets, 2);
  EXPECT_DOUBLE_EQ(scores.calibration[8].mean_probability, 0.82);
  EXPECT_DOUBLE_EQ(scores.calibration[8].share_right, 0.5);
  EXPECT_EQ(scores.calibration[2].bets, 1);
  EXPECT_NEAR(validation::calibration_error(scores.calibration), (2 * 0.32 + 0.2) / 3, 1e-12);
}

TEST(GapTrialScore, TimeLeavesOutTheFirstOfItsKind) {
  std::vector<validation::TrialResult> results(
      3, answered(made_up_case(validation::TrialArm::nulls, {}), verdict(validation::TrialVerdict::no_gap)));
  results[0].seconds = 100;
  results[0].first_of_its_kind = true;
  EXPECT_EQ(score_named(validation::trial_scores(results), "time of a diagnosis: median").value, 3);
}

TEST(GapTrialConfusion, ACaseCountsForEachEffectThatIsThere) {
  const validation::TrialCase pair = made_up_case(validation::TrialArm::pairs, {"fin_gain", "fin_lag"});
  const std::vector<validation::TrialResult> results{
      answered(pair, named({"fin_gain"})), answered(pair, named({"fin_gain", "yaw_damping"})),
      answered(made_up_case(validation::TrialArm::nulls, {}), verdict(validation::TrialVerdict::no_gap)),
      answered(made_up_case(validation::TrialArm::foreign, {"fouling"}),
               verdict(validation::TrialVerdict::unknown)),
      answered(made_up_case(validation::TrialArm::single_tenth, {"hard_iron"}),
               verdict(validation::TrialVerdict::no_gap))};
  const validation::TrialConfusion confusion = validation::trial_confusion(results);
  EXPECT_EQ(confusion.count("fin_gain", "fin_gain"), 2);
  EXPECT_EQ(confusion.count("fin_lag", "left out"), 1);
  EXPECT_EQ(confusion.count("fin_lag", "yaw_damping"), 1);
  EXPECT_EQ(confusion.count("no effect", "no gap"), 1);
  EXPECT_EQ(confusion.count("foreign to the library", "unknown"), 1);
  EXPECT_EQ(confusion.count("hard_iron", "no gap"), 0);
}

/// A case of a vehicle with thrusters.
validation::TrialCase case_of_layout(validation::TrialArm arm, std::vector<validation::TrialEffect> effects,
                                     std::string excluded = "") {
  validation::TrialCase drawn;
  drawn.arm = arm;
  drawn.effects = std::move(effects);
  drawn.excluded = std::move(excluded);
  drawn.on_layout = std::make_shared<validation::LayoutCase>();
  return drawn;
}

validation::TrialOutcome outcome_of(const validation::TrialCase& drawn, const validation::TrialAnswer& answer) {
  return validation::judged(answered(drawn, answer)).outcome;
}

const validation::TrialEffect kWeak{"thrust_scale", {}, {{"scale", -0.2}}, "thruster.2", "front_port"};
const validation::TrialEffect kHeavy{"weight", {}, {{"mass_kg", 0.2}}};

TEST(GapTrialScore, OutcomesOfLayoutsAreByNameAndPlace) {
  const validation::TrialCase weak = case_of_layout(validation::TrialArm::single, {kWeak});
  using enum validation::TrialOutcome;
  EXPECT_EQ(outcome_of(weak, named({"thrust_scale of thruster.2"})), exact);
  EXPECT_EQ(outcome_of(weak, named({"thrust_scale of front_port"})), exact);
  EXPECT_EQ(outcome_of(weak, named({"thrust_scale of thruster.1"})), wrong);
  EXPECT_EQ(outcome_of(weak, named({"thrust_scale"})), wrong);
  EXPECT_EQ(outcome_of(weak, named({"thruster_offset of thruster.2"})), in_class);
  EXPECT_EQ(outcome_of(weak, named({"hard_iron"})), wrong);
  validation::TrialAnswer confused = named({"hard_iron"});
  confused.twins = {"thrust_scale of thruster.2"};
  EXPECT_EQ(outcome_of(weak, confused), in_class);
  EXPECT_EQ(outcome_of(weak, named({"thrust_scale of thruster.2", "hard_iron"})), wrong);
  EXPECT_EQ(outcome_of(weak, verdict(validation::TrialVerdict::unknown)), unknown);
  EXPECT_EQ(outcome_of(weak, verdict(validation::TrialVerdict::no_gap)), no_gap);
  EXPECT_EQ(outcome_of(weak, verdict(validation::TrialVerdict::cannot_say)), cannot_say);
  validation::TrialResult crashed;
  crashed.drawn = weak;
  EXPECT_EQ(validation::judged(crashed).outcome, failed);
}

TEST(GapTrialScore, OfTwoEffectsOfALayoutOneIsAPart) {
  const validation::TrialCase both = case_of_layout(validation::TrialArm::pairs, {kWeak, kHeavy});
  using enum validation::TrialOutcome;
  EXPECT_EQ(outcome_of(both, named({"weight"})), part);
  EXPECT_EQ(outcome_of(both, named({"weight", "thrust_scale of thruster.2"})), exact);
  EXPECT_EQ(outcome_of(both, named({"buoyancy", "thrust_scale of thruster.2"})), in_class);
}

TEST(GapTrialScore, WhatIsNotInTheLibraryOfALayoutCannotBeExact) {
  using enum validation::TrialOutcome;
  const validation::TrialCase removed = case_of_layout(validation::TrialArm::removed, {kHeavy}, "weight");
  EXPECT_EQ(outcome_of(removed, named({"buoyancy"})), in_class);
  EXPECT_EQ(outcome_of(removed, named({"compass_lag"})), wrong);
  // The arm between the centres is one cause, and a hard iron is a deviation in the heading.
  const validation::TrialEffect arm{"gravity_shift", {}, {{"x_m", 0.001}}};
  EXPECT_EQ(
      outcome_of(case_of_layout(validation::TrialArm::removed, {arm}, "gravity_shift"), named({"buoyancy_shift"})),
      in_class);
  const validation::TrialEffect iron{"hard_iron", {}, {{"x_uT", 1}}};
  EXPECT_EQ(outcome_of(case_of_layout(validation::TrialArm::single, {iron}), named({"compass_deviation"})),
            in_class);
  const auto foreign = case_of_layout(validation::TrialArm::foreign, {{"leak", {}, {{"N_s", 0.01}}}});
  EXPECT_EQ(outcome_of(foreign, named({"weight"})), wrong);
  EXPECT_TRUE(validation::judged(answered(foreign, verdict(validation::TrialVerdict::cannot_say))).right);
  EXPECT_EQ(outcome_of(case_of_layout(validation::TrialArm::nulls, {}), named({"weight"})), wrong);
}

TEST(GapTrialScore, OfLayoutsOnlyScoresWithCasesAreListed) {
  validation::TrialAnswer right = named({"weight"});
  right.effects[0].parameters = {{"mass_kg", {0.21, 0.006}}};
  right.closed = 0.98;
  const validation::TrialCase null = case_of_layout(validation::TrialArm::nulls, {});
  std::vector<validation::TrialResult> results{
      answered(null, verdict(validation::TrialVerdict::no_gap)),
      answered(null, verdict(validation::TrialVerdict::cannot_say)),
      answered(case_of_layout(validation::TrialArm::single, {kHeavy}), right)};
  results.push_back({});
  results.back().drawn = null;
  const validation::TrialScores scores = validation::trial_scores(results);
  EXPECT_EQ(score_named(scores, "single-1: exact").hits, 1);
  EXPECT_EQ(score_named(scores, "single-1: exact, or its class").hits, 1);
  EXPECT_EQ(score_named(scores, "nulls: flagged").hits, 0);
  EXPECT_EQ(score_named(scores, "nulls: flagged").cases, 3);
  EXPECT_EQ(score_named(scores, "no answer").hits, 1);
  EXPECT_EQ(score_named(scores, "parameters within 2 standard errors").hits, 1);
  EXPECT_EQ(score_named(scores, "closure: median").value, 0.98);
  for (const validation::TrialScore& score : scores.scores) EXPECT_GT(score.cases, 0) << score.name;
  EXPECT_EQ(validation::trial_confusion(results).count("weight", "weight"), 1);
}

}  // namespace
}  // namespace navcal::cli
