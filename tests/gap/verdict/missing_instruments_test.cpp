// SPDX-License-Identifier: Apache-2.0
// Whole diagnoses without some of the instruments: an effect that only they could show is never named, and one
// that the others show is.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "gap/verdict/request.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap {
namespace {

class DiagnoseWithout : public testing::Test {
 protected:
  Diagnosis diagnosis(std::initializer_list<const char*> instruments, std::string_view effects,
                      std::string_view mission = "identification") {
    Request request;
    request.missions = {folder_ / "a.cap"};
    request.holdouts = {folder_ / "b.cap"};
    test::write_mission(request.missions.front(), mission, effects, 150, 1);
    test::write_mission(request.holdouts.front(), mission, effects, 150, 2);
    for (const char* const name : instruments) {
      const auto quantities = quantities_named(name);
      request.without.insert(request.without.end(), quantities.begin(), quantities.end());
    }
    request.bank_missions = 20;
    return diagnose(request, [](std::string_view, double) {});
  }
  static bool is_not_judged(const Diagnosis& found, std::string_view effect) {
    const auto& names = found.instruments.not_judged;
    return std::find(names.begin(), names.end(), effect) != names.end();
  }
  static bool is_named_or_likely(const Diagnosis& found, std::string_view effect) {
    const auto is_it = [&](const EffectFinding& finding) { return finding.name == effect; };
    return std::any_of(found.effects.begin(), found.effects.end(), is_it) ||
           std::any_of(found.candidates.begin(), found.candidates.end(), is_it);
  }
  navcal::test::TemporaryFolder folder_;
};

TEST_F(DiagnoseWithout, GpsACurrentIsNotJudged) {
  const Diagnosis found = diagnosis({"gps"}, "[water_current]\nnorth_m_s = 0.12\neast_m_s = -0.12\n");
  EXPECT_EQ(found.instruments.missing, std::vector<std::string>{"GPS"});
  EXPECT_TRUE(is_not_judged(found, "water_current"));
  EXPECT_FALSE(is_named_or_likely(found, "water_current"));
  EXPECT_EQ(found.verdict, Verdict::no_gap) << found.sentence;
}

TEST_F(DiagnoseWithout, CardTheFieldOfTheMotorIsFoundAndNoErrorOfAGyro) {
  const Diagnosis found =
      diagnosis({"card"}, "[motor_field]\nx_uT_per_A = 1.6\ny_uT_per_A = -1.2\n[gyro_scale]\nscale_az = 0.06\n");
  EXPECT_TRUE(is_not_judged(found, "gyro_scale"));
  EXPECT_FALSE(is_named_or_likely(found, "gyro_scale"));
  for (const EffectFinding& effect : found.effects) EXPECT_EQ(effect.name, "motor_field") << found.sentence;
}

TEST_F(DiagnoseWithout, CompassNoIronIsNamed) {
  const Diagnosis found = diagnosis({"compass"}, "[hard_iron]\nx_uT = 4\n");
  EXPECT_TRUE(is_not_judged(found, "hard_iron"));
  EXPECT_FALSE(is_named_or_likely(found, "hard_iron"));
  EXPECT_NE(found.verdict, Verdict::explained) << found.sentence;
}

TEST_F(DiagnoseWithout, AnyInstrumentNothingCanBeSaid) {
  const Diagnosis found = diagnosis({"compass", "card", "gps"}, "[hard_iron]\nx_uT = 4\n");
  EXPECT_EQ(found.verdict, Verdict::unknown);
  EXPECT_TRUE(found.effects.empty() && found.candidates.empty());
  EXPECT_NE(found.sentence.find("nothing can be said"), std::string::npos) << found.sentence;
}

}  // namespace
}  // namespace navcal::gap
