// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>

#include "report/gap_report.h"
#include "report/simulators/transfer.h"
#include "tests/report/gap_samples.h"

namespace navcal::report {
namespace {

std::string refusal_of(const std::string& json) {
  try {
    static_cast<void>(gap_from_json(json, "a.json"));
  } catch (const BadDiagnosis& error) {
    return error.what();
  }
  return "nothing was refused";
}

void expect_same(const std::vector<gap::EffectFinding>& a, const std::vector<gap::EffectFinding>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].probability, b[i].probability);
    ASSERT_EQ(a[i].parameters.size(), b[i].parameters.size());
    for (std::size_t k = 0; k < a[i].parameters.size(); ++k) {
      EXPECT_EQ(a[i].parameters[k].name, b[i].parameters[k].name);
      EXPECT_EQ(a[i].parameters[k].value, b[i].parameters[k].value);
      EXPECT_EQ(a[i].parameters[k].std_error, b[i].parameters[k].std_error);
    }
    ASSERT_EQ(a[i].confused_with.size(), b[i].confused_with.size());
    for (std::size_t k = 0; k < a[i].confused_with.size(); ++k)
      EXPECT_EQ(a[i].confused_with[k].tie_breaker, b[i].confused_with[k].tie_breaker);
  }
}

TEST(GapFromJson, ADiagnosisComesBack) {
  for (auto diagnosis : {cli::test::explained_gap(), cli::test::unknown_gap(), cli::test::no_gap()}) {
    diagnosis.field = gap::EarthField{gap::EarthField::Source::model, {15.12, 1.86, 49.2}, {}, {}};
    const gap::Diagnosis back = gap_from_json(gap_json(diagnosis), "a.json");
    EXPECT_EQ(back.verdict, diagnosis.verdict);
    EXPECT_EQ(back.sentence, diagnosis.sentence);
    expect_same(back.effects, diagnosis.effects);
    expect_same(back.candidates, diagnosis.candidates);
    ASSERT_TRUE(back.field);
    EXPECT_EQ(back.field->north_east_down_uT, diagnosis.field->north_east_down_uT);
  }
}

TEST(GapFromJson, WhatIsNotKnownIsNotANumber) {
  auto diagnosis = cli::test::hostile_gap();
  diagnosis.field = gap::EarthField{gap::EarthField::Source::model, {15, NAN, 49}, {}, {}};
  const gap::Diagnosis back = gap_from_json(gap_json(diagnosis), "a.json");
  ASSERT_EQ(back.effects.size(), 1U);
  EXPECT_TRUE(std::isnan(back.effects[0].probability));
  EXPECT_FALSE(back.field);
}

TEST(GapFromJson, AnEffectOfOneActuatorIsNotThatOfTheVehicle) {
  const gap::Diagnosis back = gap_from_json(
      R"({"verdict": "explained", "effects": [
          {"name": "thrust_scale", "of": "thruster.1", "probability": 1, "parameters": {"scale": 0.1}, "std_errors": {}},
          {"name": "thrust_scale", "of": "thruster.2", "probability": 1, "parameters": {"scale": 0.2}, "std_errors": {}}]})",
      "a.json");
  ASSERT_EQ(back.effects.size(), 2U);
  EXPECT_EQ(back.effects[0].words(), "thrust_scale of thruster.1");
  EXPECT_NE(gap_effects_file(back).find("of = \"thruster.2\""), std::string::npos) << gap_effects_file(back);
  const SimulatorFile file = simulator_file(Simulator::stonefish, {back, "a.json", {}, {}});
  EXPECT_EQ(file.text.find("thrust_coeff"), std::string::npos);
  EXPECT_NE(file.summary.find("left out: thrust_scale of thruster.1 ("), std::string::npos) << file.summary;
}

TEST(GapFromJson, BadFilesAreNamedWithTheirPlace) {
  EXPECT_EQ(refusal_of("{\n\"verdict\": }"), "a.json:2: no JSON");
  EXPECT_EQ(refusal_of(""), "a.json:1: no JSON");
  EXPECT_EQ(refusal_of("[]"), "a.json: no object");
  EXPECT_EQ(refusal_of("{}"), "a.json: the key verdict is missing");
  EXPECT_EQ(refusal_of(R"({"verdict": 3})"), "a.json: verdict: no text");
  EXPECT_EQ(refusal_of(R"({"verdict": "sure", "effects": []})"),
            "a.json: verdict: no verdict; known are no-gap, explained and unknown");
  EXPECT_EQ(refusal_of(R"({"verdict": "explained", "effects": {}})"), "a.json: effects: no list");
  EXPECT_EQ(refusal_of(R"({"verdict": "explained", "effects": [7]})"), "a.json: effects[0]: no object");
  const std::string effect =
      R"({"name": "buoyancy", "probability": 1, "parameters": {"force_N": 1}, "std_errors": {}})";
  EXPECT_EQ(refusal_of(R"({"verdict": "explained", "effects": [)" + effect + ", " + effect + "]}"),
            "a.json: effects[1]: buoyancy is named twice");
  EXPECT_EQ(refusal_of(R"({"verdict": "explained", "effects": [{"name": "buoyancy", "probability": 1,
                          "parameters": {"force_N": "much"}, "std_errors": {}}]})"),
            "a.json: effects[0].parameters.force_N: no number");
  EXPECT_EQ(refusal_of(R"({"verdict": "no-gap", "effects": [], "field": {"north_east_down_uT": [1, 2]}})"),
            "a.json: field.north_east_down_uT: not three numbers");
  EXPECT_EQ(refusal_of(R"({"verdict": "no-gap", "effects": [], "bank": 1e999})"),
            "a.json: a number that is too large");
  EXPECT_EQ(refusal_of(std::string(100'000, '[')), "a.json:1: no JSON");
}

}  // namespace
}  // namespace navcal::report
