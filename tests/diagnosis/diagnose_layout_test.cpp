// SPDX-License-Identifier: Apache-2.0
// Diagnoses of a small vehicle with four thrusters; more whole ones are among the nightly tests.
#include <gtest/gtest.h>

#include "tests/diagnosis/micro_case.h"

namespace navcal::diagnosis {
namespace {

TEST(DiagnoseLayout, AWeakThrusterIsNamedWithItsPlaceAndStrength) {
  const auto of = micro();
  const gap::Diagnosis answer = diagnosis_of(of, changed(of.prior, "thrust_scale", "thruster.2", {-0.2}));
  ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.effects.size(), 1U);
  EXPECT_EQ(answer.effects[0].name, "thrust_scale");
  EXPECT_EQ(answer.effects[0].of, "thruster.2");
  const auto& estimate = answer.effects[0].parameters.at(0);
  EXPECT_NEAR(estimate.value, -0.2, 4 * estimate.std_error);
  // The power of noise that most readings are hides so small a gap; the held-out recording is better described.
  EXPECT_LT(answer.gap.pooled.after, answer.gap.pooled.before);
}

// So large a gap was "no gap": the nominal vehicle's tolerances took it up, hundreds of their errors from zero.
TEST(DiagnoseLayout, AThrusterAtFourTenthsIsNamed) {
  const auto of = micro();
  const gap::Diagnosis answer = diagnosis_of(of, changed(of.prior, "thrust_scale", "thruster.1", {-0.6}));
  ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.effects.size(), 1U) << answer.sentence;
  EXPECT_EQ(answer.effects[0].words(), "thrust_scale of thruster.1");
  const auto& estimate = answer.effects[0].parameters.at(0);
  EXPECT_NEAR(estimate.value, -0.6, 4 * estimate.std_error);
}

// The filter of the nominal vehicle is led astray by these, and with its gains nothing explained them.
TEST(DiagnoseLayout, AThrusterThatIsDeadOrReversedIsNamed) {
  const auto of = micro();
  for (const auto& [effect, part] :
       {std::pair{"actuator_dead", "thruster.1"}, {"actuator_reversed", "thruster.3"}}) {
    const gap::Diagnosis answer = diagnosis_of(of, changed(of.prior, effect, part, {1}));
    ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
    ASSERT_EQ(answer.effects.size(), 1U) << answer.sentence;
    EXPECT_EQ(answer.effects[0].words(), std::string(effect) + " of " + part);
  }
}

TEST(DiagnoseLayout, ALateCompassIsNamed) {
  const auto of = micro();
  const auto late = [&](std::uint64_t seed) {
    identify::RecordedMotion motion = recording(of, of.prior, seed);
    for (identify::Reading& heading : motion.channels[static_cast<std::size_t>(identify::Channel::heading)])
      heading.time_s += 0.2;
    return motion;
  };
  const gap::Diagnosis answer =
      diagnose({.layout = of.prior, .excluded = {}, .threads = 1},
               {late(1), {}, {recording(of, of.prior, 11), recording(of, of.prior, 31)}, {late(21)}},
               [](std::string_view, double) {});
  ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.effects.size(), 1U);
  EXPECT_EQ(answer.effects[0].name, "compass_lag");
  EXPECT_NEAR(answer.effects[0].parameters.at(0).value, 0.2, 0.03);
}

TEST(DiagnoseLayout, MissingCommandsAreSaid) {
  const auto of = micro();
  identify::RecordedMotion without = recording(of, of.prior, 1);
  without.signals.clear();
  const gap::Diagnosis answer =
      diagnose({.layout = of.prior, .excluded = {}}, {without, {}, {}}, [](std::string_view, double) {});
  EXPECT_EQ(answer.verdict, gap::Verdict::unknown);
  EXPECT_NE(answer.sentence.find("cannot be diagnosed"), std::string::npos) << answer.sentence;
  EXPECT_TRUE(answer.effects.empty());
}

TEST(DiagnoseLayout, ProgressMayEndIt) {
  const auto of = micro();
  struct Ended {};
  EXPECT_THROW(
      static_cast<void>(diagnose({.layout = of.prior, .excluded = {}}, {recording(of, of.prior, 1), {}, {}},
                                 [](std::string_view, double) { throw Ended(); })),
      Ended);
}

}  // namespace
}  // namespace navcal::diagnosis
