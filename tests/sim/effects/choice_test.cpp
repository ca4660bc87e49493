// SPDX-License-Identifier: Apache-2.0
// Effects by strength and from a file.
#include "sim/effects/choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "sim/effects/document.h"
#include "sim/layout/effects/layout_effects.h"
#include "tests/sim/effects/at_rest.h"

namespace navcal::sim::testing {
namespace {

TEST(EffectChoice, StrengthCountsTypicalStrengthsAndTheSeedGivesTheDirection) {
  for (const EffectEntry& entry : effect_table()) {
    const auto effect = entry.make();
    const EffectDescription& about = effect->description();
    Noise noise(1), again(1), other(2);
    const auto values = drawn_parameters(about, 0.5, noise);
    EXPECT_EQ(values, drawn_parameters(about, 0.5, again)) << about.name;
    if (about.vector > 1) {
      EXPECT_NE(values, drawn_parameters(about, 0.5, other)) << about.name;
    }
    ASSERT_EQ(values.size(), about.parameters.size());
    for (std::size_t first = 0; first < values.size(); first += about.vector) {
      double square = 0;
      for (std::size_t i = first; i < first + about.vector; ++i) {
        EXPECT_FALSE(refusal(about.parameters[i], values[i])) << about.name;
        square += std::pow(values[i] / about.parameters[i].typical, 2);
      }
      EXPECT_NEAR(std::sqrt(square), 0.5, 1e-12) << about.name;
    }
  }
}

TEST(EffectChoice, SoftIronOfStrengthOneHasTheNormOfItsTable) {
  Noise noise(9);
  const auto s = drawn_parameters(make_effect("soft_iron")->description(), 1, noise);
  const double norm2 = s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
  EXPECT_NEAR(std::sqrt(norm2), 0.05, 1e-12);
}

TEST(EffectChoice, OutOfRangeIsSaidWithTheRange) {
  const EffectParameter tau{"tau_s", 0.2, 0, 10};
  EXPECT_EQ(refusal(tau, -0.1), "tau_s lies between 0 and 10, not at -0.1");
  EXPECT_TRUE(refusal(tau, std::nan("")));
  EXPECT_FALSE(refusal(tau, 0));
}

std::vector<std::string> complaints(std::string_view toml, EffectSet& set) {
  std::vector<config::Problem> problems;
  add_effects(toml, set, problems);
  std::vector<std::string> texts;
  for (const auto& problem : problems) {
    texts.push_back(std::to_string(problem.line) + ": " + problem.key + ": " + problem.message);
  }
  return texts;
}

TEST(EffectDocument, TakesExactParametersAndIntervals) {
  EffectSet set;
  const auto said = complaints("[motor_field]\ny_uT_per_A = 0.5\nfrom_s = 10\n[fin_lag]\ntau_s = 1\n", set);
  EXPECT_TRUE(said.empty()) << said.front();
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0].description().name, "fin_lag");
  EXPECT_EQ(set[0].parameters()[0], 1);
  EXPECT_EQ(set[1].parameters()[1], 0.5);
  EXPECT_EQ(set.interval(1).from_s, 10);
  EXPECT_FALSE(std::isfinite(set.interval(1).until_s));
}

struct Refused {
  const char* toml;
  const char* said;
};
struct EffectDocumentRefuses : ::testing::TestWithParam<Refused> {};

TEST_P(EffectDocumentRefuses, WithLineKeyAndReasonAndAddsNothing) {
  EffectSet set;
  const auto said = complaints(GetParam().toml, set);
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.front().substr(0, std::string_view(GetParam().said).size()), GetParam().said);
  EXPECT_EQ(set.size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Texts, EffectDocumentRefuses,
    ::testing::Values(
        Refused{"\n[motor_fields]\n", "2: motor_fields: there is no such effect; did you mean motor_field?"},
        Refused{"[hard_iron]\nx_ut = 1\n", "2: hard_iron.x_ut: unknown key; did you mean x_uT?"},
        Refused{"[hard_iron]\nx_uT = 1\n[fin_lag]\ntau_s = 11\n",
                "4: fin_lag.tau_s: tau_s lies between 0 and 5, not at 11"},
        Refused{"[fin_lag]\ntau_s = '1'\n", "2: fin_lag.tau_s: a number is expected, not the text \"1\""},
        Refused{"[fin_lag]\ntau_s = nan\n", "2: fin_lag.tau_s: a number is expected"},
        Refused{"fin_lag = 1\n", "1: fin_lag: a table with its parameters is expected"},
        Refused{"[fin_lag]\n", "1: fin_lag: none of its parameters is given"},
        Refused{"[fin_lag]\ntau_s = 1\nfrom_s = 5\nuntil_s = 5\n", "1: fin_lag: until_s must lie after from_s"},
        Refused{"[fin_lag.tau_s]\nx = 1\n", "1: fin_lag"}, Refused{"[fin_lag", "1: : "}));

TEST(EffectText, ListsEveryEffectInOneLine) {
  const std::string text = effects_text();
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), effect_table().size() + 2);
  EXPECT_NE(text.find("| motor_field | m += k I | x_uT_per_A y_uT_per_A z_uT_per_A | 1, as a vector |\n"),
            std::string::npos);
}

TEST(EffectText, IsTheTableOfTheDocumentation) {
  std::ifstream in(NAVCAL_SOURCE_DIR "/docs/simulator.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(page.find(effects_text()), std::string::npos)
      << "put the output of navcal simulate --list-effects there";
  EXPECT_NE(page.find(layout_effects_text()), std::string::npos)
      << "put the output of navcal simulate --list-effects there";
}

}  // namespace
}  // namespace navcal::sim::testing
