// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "report/gap_report.h"
#include "sim/effects/document.h"
#include "sim/effects/effect_table.h"
#include "tests/report/gap_samples.h"

namespace navcal::cli {
namespace {

sim::EffectSet read_back(const std::string& toml) {
  sim::EffectSet set;
  std::vector<config::Problem> problems;
  sim::add_effects(toml, set, problems);
  for (const auto& problem : problems) ADD_FAILURE() << problem.line << ": " << problem.message << '\n' << toml;
  return set;
}

const sim::Effect* find(const sim::EffectSet& set, std::string_view name) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i].description().name == name) return &set[i];
  }
  return nullptr;
}

TEST(GapEffectsFile, EveryEffectComesBackToTheLastBit) {
  gap::Diagnosis diagnosis;
  double value = 0.1;
  for (const auto& entry : sim::effect_table()) {
    gap::EffectFinding found{std::string(entry.name), 0.5, {}, {}};
    const auto effect = entry.make();
    for (const auto& parameter : effect->description().parameters) {
      value = std::fmod(value * 1.7 + 0.013, 1);
      found.parameters.push_back({std::string(parameter.name), parameter.typical * value, 1e-3});
    }
    diagnosis.effects.push_back(std::move(found));
  }
  const auto set = read_back(report::gap_effects_file(diagnosis));
  ASSERT_EQ(set.size(), diagnosis.effects.size());
  for (const auto& found : diagnosis.effects) {
    const auto* const effect = find(set, found.name);
    ASSERT_NE(effect, nullptr) << found.name;
    for (std::size_t i = 0; i < found.parameters.size(); ++i) {
      EXPECT_EQ(effect->parameters()[i], found.parameters[i].value) << found.parameters[i].name;
    }
  }
}

TEST(GapEffectsFile, NothingFoundIsAFileWithoutEffects) {
  for (const auto& diagnosis : {gap::Diagnosis{}, test::unknown_gap(), test::no_gap()}) {
    const std::string toml = report::gap_effects_file(diagnosis);
    EXPECT_EQ(read_back(toml).size(), 0U);
    EXPECT_NE(toml.find("No effect"), std::string::npos);
  }
}

TEST(GapEffectsFile, WhatTheSimulatorWouldRefuseIsBroughtWithinItsRange) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  gap::Diagnosis diagnosis;
  diagnosis.effects = {{"compass_lag", 0.9, {{"tau_s", -0.01, 0.02}}, {}},
                       {"thrust_scale", kNan, {{"scale", kNan, kNan}}, {}},
                       {"hard_iron", 1, {{"x_uT", 1e300, 1}, {"y_uT", -0.0, kNan}, {"z_uT", 3, 0}}, {}}};
  const std::string toml = report::gap_effects_file(diagnosis);
  const auto set = read_back(toml);
  ASSERT_EQ(set.size(), 3U);
  EXPECT_EQ(find(set, "compass_lag")->parameters()[0], 0);
  EXPECT_EQ(find(set, "thrust_scale")->parameters()[0], 0);
  EXPECT_EQ(find(set, "hard_iron")->parameters()[2], 3);
  EXPECT_TRUE(std::isfinite(find(set, "hard_iron")->parameters()[0]));
  EXPECT_NE(toml.find("-0.01 +- 0.02, outside the range of the simulator"), std::string::npos) << toml;
}

TEST(GapEffectsFile, WhatTheSimulatorDoesNotHaveIsAComment) {
  gap::Diagnosis diagnosis;
  diagnosis.effects = {{"thrust_scale of thruster.2\n[hard_iron]", 0.9, {{"scale", 0.1, 0.02}}, {}}};
  const std::string toml = report::gap_effects_file(diagnosis);
  EXPECT_EQ(read_back(toml).size(), 0U);
  EXPECT_NE(toml.find("# thrust_scale of thruster.2 [hard_iron]: the simulator has no such effect."),
            std::string::npos)
      << toml;
}

TEST(GapEffectsFile, StandardErrorsStandBesideTheValues) {
  const std::string toml = report::gap_effects_file(test::explained_gap());
  EXPECT_NE(toml.find("x_uT_per_A = 0.8031  # +- 0.0042"), std::string::npos) << toml;
  EXPECT_NE(toml.find("[motor_field]"), std::string::npos);
}

}  // namespace
}  // namespace navcal::cli
