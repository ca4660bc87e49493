// SPDX-License-Identifier: Apache-2.0
#include "runs/diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/runs/four_thrusters.h"

namespace navcal::runs {
namespace {

class DiagnosisOfRuns : public ::testing::Test {
 protected:
  static const NominalVehicle& vehicle() {
    static const NominalVehicle identified = identify(test::nominal_runs(6, 8, 100));
    return identified;
  }
  static RunDiagnosis of_pool(const test::Trait& trait, std::uint32_t seed,
                              const EffectInformation* removed = nullptr) {
    std::vector<Response> responses;
    for (const runs::Run& run : test::session_of(trait, 10, seed))
      responses.push_back(response_of(run, vehicle().clock));
    return diagnose(vehicle(), responses, removed);
  }
  static std::string first_of(const RunDiagnosis& diagnosis) {
    return diagnosis.effects.empty() ? std::string(verdict_name(diagnosis.verdict)) : diagnosis.effects[0].name;
  }
};

TEST_F(DiagnosisOfRuns, KnowsTheNominalVehicle) {
  EXPECT_EQ(vehicle().parameters.sessions, 6U);
  EXPECT_NEAR(vehicle().clock.row_rate_Hz, 20, 0.1);
  EXPECT_EQ(vehicle().clock.stop_command_us, 1100);
  EXPECT_TRUE(vehicle().remarks.empty());
}

TEST_F(DiagnosisOfRuns, DoesNotFlagNominalSessions) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    test::Trait trait;
    trait.command_us = 1180 + 3 * seed;  // no session of the nominal runs had these commands
    const RunDiagnosis found = of_pool(trait, seed);
    EXPECT_TRUE(found.effects.empty()) << seed << ' ' << first_of(found);
    EXPECT_NE(found.verdict, Verdict::unknown) << seed;
  }
}

TEST_F(DiagnosisOfRuns, NamesWeight) {
  test::Trait trait;
  trait.weight_share = 0.4;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) EXPECT_EQ(first_of(of_pool(trait, seed)), "AddWeight");
}

TEST_F(DiagnosisOfRuns, NamesTheDepthSensorWhateverItsSign) {
  test::Trait trait;
  for (const double zero_m : {-0.1, 0.1, 0.3}) {
    trait.depth_zero_m = zero_m;
    EXPECT_EQ(first_of(of_pool(trait, 7)), "PressureGain_constant") << zero_m;
  }
}

TEST_F(DiagnosisOfRuns, NamesABadPropeller) {
  test::Trait trait;
  trait.lost_thrust = 0.5;
  trait.ripple_rad_s = 0.03;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) EXPECT_EQ(first_of(of_pool(trait, seed)), "PropellerDamage_bad");
}

/// The command must not give the cause away: a dive as deep as nominal at a command as nominal is nominal, and a
/// run that is weak in proportion to its command too.
TEST_F(DiagnosisOfRuns, TheCommandAloneIsNoEvidence) {
  for (const double command_us : {1150.0, 1250.0, 1300.0}) {
    test::Trait trait;
    trait.command_us = command_us;
    EXPECT_TRUE(of_pool(trait, 3).effects.empty()) << command_us;
  }
}

TEST_F(DiagnosisOfRuns, ARemovedEffectIsNeverNamed) {
  test::Trait weight, sensor;
  weight.weight_share = 0.5;
  sensor.depth_zero_m = 0.2;
  const RunDiagnosis heavy = of_pool(weight, 1, effect_named("AddWeight"));
  EXPECT_TRUE(heavy.effects.empty());
  EXPECT_NE(heavy.verdict, Verdict::nominal);
  EXPECT_EQ(of_pool(sensor, 1, effect_named("depth_sensor_failed")).verdict, Verdict::unknown);
}

TEST_F(DiagnosisOfRuns, ProbabilitiesAddUpToOne) {
  const RunDiagnosis found = of_pool({}, 2);
  double sum = 0;
  for (const auto& candidate : found.candidates) sum += candidate.probability;
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_TRUE(std::ranges::is_sorted(found.candidates, std::greater{}, &Candidate::probability));
}

TEST_F(DiagnosisOfRuns, WithoutThrustNothingIsDecided) {
  test::Trait idle;
  idle.command_us = 1100;
  const RunDiagnosis found = of_pool(idle, 1);
  EXPECT_EQ(found.verdict, Verdict::undecided);
  EXPECT_EQ(found.runs_used, 0U);
}

TEST(NominalRuns, TooFewOrNeverDrivenAreRefused) {
  EXPECT_THROW(static_cast<void>(identify({})), BadNominal);
  EXPECT_THROW(static_cast<void>(identify(test::nominal_runs(1, 3, 1))), BadNominal);
  test::Trait idle;
  idle.command_us = 1100;
  EXPECT_THROW(static_cast<void>(identify(test::session_of(idle, 8, 1))), BadNominal);
}

TEST(NominalRuns, OfOneSessionAreRemarkedOn) {
  const NominalVehicle vehicle = identify(test::nominal_runs(1, 8, 1));
  ASSERT_EQ(vehicle.remarks.size(), 1U);
  EXPECT_NE(vehicle.remarks[0].find("1 session "), std::string::npos);
}

TEST(EffectNames, AreFoundInAnyCaseOfLetters) {
  EXPECT_EQ(effect_named("addweight"), &kEffects[0]);
  EXPECT_EQ(effect_named("Propeller_Damaged_Badly"), &kEffects[3]);
  EXPECT_EQ(effect_named("leak"), nullptr);
  EXPECT_EQ(effect_named(""), nullptr);
}

}  // namespace
}  // namespace navcal::runs
