// SPDX-License-Identifier: Apache-2.0
// Whole diagnoses of a small vehicle with four thrusters.
#include "diagnosis/diagnose_layout.h"

#include <gtest/gtest.h>

#include "sim/layout/effects/layout_effects.h"
#include "tests/identify/identification_case.h"

namespace navcal::diagnosis {
namespace {

identify::VehicleCase micro() {
  identify::VehicleCase of = identify::vehicle_case("micro");
  of.prior.uncertainties.clear();
  return of;
}

identify::RecordedMotion recording(const identify::VehicleCase& of, const config::Layout& truth,
                                   std::uint64_t seed) {
  return identify::draw_recording(of, truth, 24, seed, 0.05);
}

config::Layout changed(const config::Layout& layout, std::string_view effect, const std::string& part,
                       std::vector<double> values) {
  return sim::changed_layout(layout, {sim::find_layout_effect(effect), part, std::move(values)});
}

gap::Diagnosis diagnosis_of(const identify::VehicleCase& of, const config::Layout& truth) {
  return diagnose({.layout = of.prior, .excluded = {}, .threads = 1},
                  {recording(of, truth, 1), {}, {recording(of, of.prior, 11)}}, [](std::string_view, double) {});
}

TEST(DiagnoseLayout, ANominalVehicleHasNoGap) {
  const auto of = micro();
  const gap::Diagnosis answer = diagnosis_of(of, of.prior);
  EXPECT_EQ(answer.verdict, gap::Verdict::no_gap) << answer.sentence;
  EXPECT_TRUE(answer.effects.empty());
}

TEST(DiagnoseLayout, AWeakThrusterIsNamedWithItsPlaceAndStrength) {
  const auto of = micro();
  const gap::Diagnosis answer = diagnosis_of(of, changed(of.prior, "thrust_scale", "thruster.2", {-0.2}));
  ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.effects.size(), 1U);
  EXPECT_EQ(answer.effects[0].name, "thrust_scale");
  EXPECT_EQ(answer.effects[0].of, "thruster.2");
  const auto& estimate = answer.effects[0].parameters.at(0);
  EXPECT_NEAR(estimate.value, -0.2, 4 * estimate.std_error);
  EXPECT_GT(answer.gap.pooled.closed.value_or(0), 0.8);
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
