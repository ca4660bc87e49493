// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/diagnosis/micro_case.h"

namespace navcal::diagnosis {
namespace {

TEST(DiagnoseLayout, ANominalVehicleHasNoGap) {
  const auto of = micro();
  const gap::Diagnosis answer = diagnosis_of(of, of.prior);
  EXPECT_EQ(answer.verdict, gap::Verdict::no_gap) << answer.sentence;
  EXPECT_TRUE(answer.effects.empty());
}

TEST(DiagnoseLayout, ThreeRecordingsTogetherTellMoreThanOne) {
  const auto of = micro();
  const config::Layout truth = changed(of.prior, "thrust_scale", "thruster.2", {-0.06});
  const LayoutRequest request{.layout = of.prior, .excluded = {}, .threads = 1};
  LayoutRecordings recordings{
      recording(of, truth, 1), {}, {recording(of, of.prior, 11), recording(of, of.prior, 31)}, {}};
  const auto alone = diagnose(request, recordings, [](std::string_view, double) {});
  recordings.others = {recording(of, truth, 21), recording(of, truth, 41)};
  const auto together = diagnose(request, recordings, [](std::string_view, double) {});
  ASSERT_EQ(together.verdict, gap::Verdict::explained) << together.sentence;
  EXPECT_EQ(together.effects[0].words(), "thrust_scale of thruster.2");
  const auto& estimate = together.effects[0].parameters.at(0);
  EXPECT_NEAR(estimate.value, -0.06, 4 * estimate.std_error);
  ASSERT_FALSE(alone.candidates.empty());
  EXPECT_LT(estimate.std_error, 0.9 * alone.candidates[0].parameters.at(0).std_error);
  ASSERT_EQ(together.recordings.size(), 3U);
  for (const gap::RecordingFinding& one : together.recordings)
    EXPECT_NEAR(one.effects.at(0).parameters.at(0).value, -0.06, 4 * one.effects[0].parameters[0].std_error);
  EXPECT_FALSE(together.differences.at(0).differs);
}

TEST(DiagnoseLayout, WithoutNominalRecordingsNothingIsNamed) {
  const auto of = micro();
  const config::Layout truth = changed(of.prior, "thrust_scale", "thruster.2", {-0.5});
  const gap::Diagnosis answer = diagnose({.layout = of.prior, .excluded = {}, .threads = 1},
                                         {recording(of, truth, 1), {}, {}}, [](std::string_view, double) {});
  EXPECT_EQ(answer.verdict, gap::Verdict::unknown) << answer.sentence;
  EXPECT_NE(answer.sentence.find("--nominal"), std::string::npos) << answer.sentence;
  EXPECT_FALSE(answer.candidates.empty());
}

TEST(DiagnoseLayout, WhatHoldsInOneRecordingAndNotInAnotherIsSaid) {
  const auto of = micro();
  const gap::Diagnosis answer =
      diagnose({.layout = of.prior, .excluded = {}, .threads = 1},
               {recording(of, changed(of.prior, "thrust_scale", "thruster.2", {-0.3}), 1),
                {},
                {recording(of, of.prior, 11), recording(of, of.prior, 31)},
                {recording(of, of.prior, 21)}},
               [](std::string_view, double) {});
  EXPECT_NE(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.recordings.size(), 2U);
  ASSERT_TRUE(answer.recordings[0].alone && answer.recordings[1].alone);
  EXPECT_EQ(answer.recordings[0].alone->effects, std::vector<std::string>{"thrust_scale of thruster.2"});
  EXPECT_TRUE(answer.recordings[1].alone->effects.empty());
}

// Two recordings of opposite changes had a dead band of one thruster and the lag of another, which neither shows.
TEST(DiagnoseLayout, ACauseThatOnlyTakesUpADisagreementIsNotNamed) {
  const auto of = micro();
  const auto with = [&](double scale, std::uint64_t seed) {
    return recording(of, changed(of.prior, "thrust_scale", "thruster.2", {scale}), seed);
  };
  const gap::Diagnosis answer =
      diagnose({.layout = of.prior, .excluded = {}, .threads = 1},
               {with(-0.25, 1), {}, {recording(of, of.prior, 11), recording(of, of.prior, 31)}, {with(0.25, 21)}},
               [](std::string_view, double) {});
  for (const gap::EffectFinding& effect : answer.effects)
    EXPECT_EQ(effect.words(), "thrust_scale of thruster.2") << answer.sentence;
}

}  // namespace
}  // namespace navcal::diagnosis
