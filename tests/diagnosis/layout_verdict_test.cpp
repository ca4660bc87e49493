// SPDX-License-Identifier: Apache-2.0
// Verdicts on searches that are made up: two causes of one column each, and three nominal recordings.
#include "diagnosis/layout_verdict.h"

#include <gtest/gtest.h>

#include <array>

#include "diagnosis/limits.h"

namespace navcal::diagnosis {
namespace {

constexpr double kReadings = 1000;

/// A search that found the first cause at strength 1, clearly, in a recording that it describes.
struct Searched {
  CauseLibrary library;
  ColumnPriors priors{Eigen::VectorXd::Constant(2, kTolerance), Eigen::VectorXd::Constant(2, 1)};
  NominalBank bank;
  CauseSearchResult found;
  std::vector<ExplainedWindows> held_out;

  Searched() {
    for (Eigen::Index i = 0; i < 2; ++i) {
      library.causes.push_back({.name = i == 0 ? "first" : "second",
                                .of = "thruster.1",
                                .manoeuvre = {},
                                .parameters = {{.name = "k", .low = -10, .high = 10, .column = i}}});
    }
    for (const double one : {0.98, 1.0, 1.02}) {
      bank.powers.push_back(one);
      bank.misfits.push_back(one);
      bank.channel_powers.emplace_back();
      bank.channel_powers.back().fill(one);
      bank.estimates.emplace_back(Eigen::VectorXd::Zero(2));
    }
    found.sets = {{{0}, -kReadings / 2, 0.99}, {{1}, -kReadings / 2 - 6, 0.008}, {{}, -kReadings, 0.002}};
    found.best.readings = kReadings;
    found.best.channel_power.fill(1);
    found.best.at = found.mean = Eigen::Vector2d(1, 0);
    found.std = Eigen::Vector2d::Constant(0.01);
    found.best.linear = {1e4 * Eigen::MatrixXd::Identity(2, 2), 1e4 * found.mean, 1e4 + kReadings};
  }

  [[nodiscard]] gap::Diagnosis verdict() const {
    gap::Diagnosis answer;
    write_verdict({library, priors, bank, found, held_out}, answer);
    return answer;
  }
};

void expect_unknown(const Searched& searched, std::string_view because) {
  const gap::Diagnosis answer = searched.verdict();
  EXPECT_EQ(answer.verdict, gap::Verdict::unknown);
  EXPECT_TRUE(answer.effects.empty());
  EXPECT_NE(answer.sentence.find(because), std::string::npos) << answer.sentence;
}

TEST(LayoutVerdict, NamesACauseThatIsClearAndDescribesTheRecording) {
  const gap::Diagnosis answer = Searched().verdict();
  ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.effects.size(), 1U);
  EXPECT_EQ(answer.effects[0].name, "first");
  EXPECT_EQ(answer.effects[0].parameters.at(0).value, 1);
}

TEST(LayoutVerdict, WithoutACauseAndALouderChannelThereIsNoGap) {
  Searched searched;
  searched.found.sets = {{{}, -kReadings / 2, 0.99}, {{0}, -kReadings / 2 - 6, 0.01}};
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::no_gap);
  searched.found.best.channel_power[0] = 3;
  expect_unknown(searched, "no effect of the library explains it");
}

TEST(LayoutVerdict, ACauseWithProbableRivalsIsNotNamed) {
  Searched searched;
  searched.found.sets[0].probability = 0.8;
  searched.found.sets[1].probability = 0.2;
  expect_unknown(searched, "a probability of 0.80 only");
}

TEST(LayoutVerdict, ACauseThatLeavesAChannelLouderIsNotNamed) {
  Searched searched;
  searched.found.best.channel_power[2] = 2;
  expect_unknown(searched, "louder than nominal");
}

// A BlueROV2 with one thruster 8 % strong: of sets that all failed to describe the recording, the best one had a
// probability of 1. It contained a damping of 0.07 +- 0.33, and an added mass that was fitted at -0.9 and
// estimated at -0.55 +- 0.04.
TEST(LayoutVerdict, TheBestOfSetsThatDoNotDescribeTheRecordingIsNotNamed) {
  Searched searched;
  for (ScoredSet& one : searched.found.sets) one.log_odds *= 2.3;
  expect_unknown(searched, "the recording departs by 2.3 times its noise power, nominal ones by 1.0 times");
}

TEST(LayoutVerdict, ACauseThatCannotBeToldFromZeroIsNotNamed) {
  Searched searched;
  searched.found.std[0] = 0.6;
  expect_unknown(searched, "the strength of first of thruster.1 cannot be told from zero");
}

TEST(LayoutVerdict, ACauseWhoseFitHasNotSettledIsNotNamed) {
  Searched searched;
  searched.found.best.at[0] = 2.5;
  expect_unknown(searched, "the fit with first of thruster.1 does not settle");
  searched.found.std[0] = 0.4;  // within its error
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::explained);
}

TEST(LayoutVerdict, ACauseThatMakesAHeldOutRecordingWorseIsNotNamed) {
  Searched searched;
  searched.held_out.push_back({-3, {1}, {1}, {1}});
  expect_unknown(searched, "does not improve the held-out recordings");
  searched.held_out.push_back({50, {1}, {1}, {1}});
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::explained);
}

TEST(LayoutVerdict, AnImplausibleStrengthIsNotNamed) {
  Searched searched;
  searched.library.causes[0].parameters[0].high = 1000;
  searched.found.best.at[0] = searched.found.mean[0] = 2 * kLargestStrength;
  expect_unknown(searched, "times its typical strength");
}

TEST(Floor, HasRoomForTheScatterAndForTolerancesThatNominalRecordingsDoNotShow) {
  EXPECT_EQ(floor_of({}).mean, 1);
  const std::array one{4.0};
  EXPECT_DOUBLE_EQ(floor_of(one).limit(), 6);
  const std::array wide{1.0, 3.0};
  EXPECT_GT(floor_of(wide).limit(), 2 + 5);
}

}  // namespace
}  // namespace navcal::diagnosis
