// SPDX-License-Identifier: Apache-2.0
#include "validation/layout_score.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "report/layout_score_report.h"

namespace navcal::validation::testing {
namespace {

using Present = LayoutTruth::Present;

LayoutTruth truth_of(LayoutArm arm, std::vector<Present> effects, std::string excluded = "") {
  return {"0001", arm, std::move(excluded), std::move(effects)};
}

LayoutAnswer answered(const std::string& verdict, const std::string& effects) {
  const auto answers = read_layout_answers(R"({"case":"0001","verdict":")" + verdict +
                                           R"(","where":[],"gap":{"closed":0.99},"effects":[)" + effects + "]}");
  return answers.front();
}

std::string effect(const std::string& name, const std::string& of, const std::string& twins = "") {
  return R"({"name":")" + name + R"(","of":")" + of + R"(","probability":0.9,"confused_with":[)" + twins + "]}";
}

const Present kWeak{"thrust_scale", "thruster.2", "front_port", {{"scale", -0.2}}};
const Present kHeavy{"weight", "", "", {{"mass_kg", 0.2}}};

TEST(LayoutScore, OutcomesAreByNameAndPlace) {
  const LayoutTruth weak = truth_of(LayoutArm::single, {kWeak});
  using enum LayoutOutcome;
  EXPECT_EQ(outcome_of(weak, answered("explained", effect("thrust_scale", "thruster.2"))), exact);
  EXPECT_EQ(outcome_of(weak, answered("explained", effect("thrust_scale", "front_port"))), exact);
  EXPECT_EQ(outcome_of(weak, answered("explained", effect("thrust_scale", "thruster.1"))), wrong);
  EXPECT_EQ(outcome_of(weak, answered("explained", effect("thrust_scale", ""))), wrong);
  EXPECT_EQ(outcome_of(weak, answered("explained", effect("thruster_offset", "thruster.2"))), in_class);
  EXPECT_EQ(outcome_of(weak, answered("explained", effect("hard_iron", ""))), wrong);
  EXPECT_EQ(outcome_of(weak, answered("explained",
                                      effect("hard_iron", "", R"({"name":"thrust_scale","of":"thruster.2"})"))),
            in_class);
  EXPECT_EQ(outcome_of(
                weak, answered("explained", effect("thrust_scale", "thruster.2") + "," + effect("hard_iron", ""))),
            wrong);
  EXPECT_EQ(outcome_of(weak, answered("unknown", "")), unknown);
  EXPECT_EQ(outcome_of(weak, answered("no-gap", "")), no_gap);
  EXPECT_EQ(outcome_of(weak, read_layout_answers(R"({"case":"0001","verdict":"cannot-say"})").front()),
            cannot_say);
  EXPECT_EQ(outcome_of(weak, read_layout_answers(R"({"case":"0001","failure":"it crashed"})").front()), failed);
}

TEST(LayoutScore, OfTwoEffectsOneIsAPart) {
  const LayoutTruth both = truth_of(LayoutArm::pairs, {kWeak, kHeavy});
  EXPECT_EQ(outcome_of(both, answered("explained", effect("weight", ""))), LayoutOutcome::part);
  EXPECT_EQ(
      outcome_of(both, answered("explained", effect("weight", "") + "," + effect("thrust_scale", "thruster.2"))),
      LayoutOutcome::exact);
  EXPECT_EQ(
      outcome_of(both, answered("explained", effect("buoyancy", "") + "," + effect("thrust_scale", "thruster.2"))),
      LayoutOutcome::in_class);
}

TEST(LayoutScore, WhatIsNotInTheLibraryCannotBeExact) {
  const LayoutTruth removed = truth_of(LayoutArm::removed, {kHeavy}, "weight");
  EXPECT_EQ(outcome_of(removed, answered("explained", effect("buoyancy", ""))), LayoutOutcome::in_class);
  EXPECT_EQ(outcome_of(removed, answered("explained", effect("compass_lag", ""))), LayoutOutcome::wrong);
  const LayoutTruth foreign = truth_of(LayoutArm::foreign, {{"leak", "", "", {{"N_s", 0.01}}}});
  EXPECT_EQ(outcome_of(foreign, answered("explained", effect("weight", ""))), LayoutOutcome::wrong);
  EXPECT_EQ(outcome_of(truth_of(LayoutArm::nulls, {}), answered("explained", effect("weight", ""))),
            LayoutOutcome::wrong);
}

TEST(LayoutScore, ScoresCountEveryCase) {
  const std::string truth =
      "{\"vehicle\":1,\"seed\":1}\n"
      R"({"case":1,"arm":"nulls","excluded":"","effects":[]})"
      "\n"
      R"({"case":2,"arm":"single-1","excluded":"","effects":[{"name":"weight","parameters":{"mass_kg":0.2}}]})"
      "\n\n"
      R"({"case":3,"arm":"nulls","excluded":"","effects":[]})"
      "\n";
  const std::string answers =
      R"({"case":"0001","verdict":"no-gap","where":[],"effects":[],"gap":{"closed":null}})"
      "\n"
      R"({"case":"0002","verdict":"explained","where":[],"gap":{"closed":0.98},"effects":[{"name":"weight","probability":0.9,)"
      R"("parameters":{"mass_kg":0.21},"std_errors":{"mass_kg":0.006}}]})";
  const auto truths = read_layout_truths(truth);
  ASSERT_EQ(truths.size(), 3U);
  const LayoutScores scores = layout_scores(truths, read_layout_answers(answers));
  EXPECT_EQ(scores.cases, 3);
  EXPECT_EQ(scores.answered, 2);
  const auto score = [&](const std::string& name) {
    for (const TrialScore& one : scores.scores) {
      if (one.name == name) return one;
    }
    throw std::runtime_error("no score " + name);
  };
  EXPECT_EQ(score("single-1: exact").hits, 1);
  EXPECT_EQ(score("nulls: flagged").hits, 0);
  EXPECT_EQ(score("nulls: flagged").cases, 2);
  EXPECT_EQ(score("no answer").hits, 1);
  EXPECT_EQ(score("parameters within 2 standard errors").hits, 1);
  EXPECT_EQ(score("closure: median").value, 0.98);
  EXPECT_NE(report::layout_score_text(scores).find("single-1: exact"), std::string::npos);
  EXPECT_NE(report::layout_score_json(scores).find("\"answered\": 2"), std::string::npos);
}

TEST(LayoutScore, BadLinesAreNamed) {
  const auto complaint = [](auto read, const std::string& lines) -> std::string {
    try {
      (void)read(lines);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(complaint(read_layout_truths, "{\"vehicle\":1}\n{").find("line 2"), std::string::npos);
  EXPECT_NE(complaint(read_layout_truths, R"({"case":1,"arm":"x","excluded":"","effects":[]})").find("no arm x"),
            std::string::npos);
  EXPECT_NE(complaint(read_layout_answers, "\n{\"case\":1}").find("line 2"), std::string::npos);
  EXPECT_NE(complaint(read_layout_answers, R"({"case":"0001","verdict":"maybe"})").find("line 1"),
            std::string::npos);
  const auto truths = read_layout_truths(R"({"case":1,"arm":"nulls","excluded":"","effects":[]})");
  const std::string line = R"({"case":"0001","verdict":"cannot-say"})";
  EXPECT_THROW((void)layout_scores(truths, read_layout_answers(line + "\n" + line)), std::runtime_error);
  EXPECT_THROW((void)layout_scores(truths, read_layout_answers(R"({"case":"0002","verdict":"cannot-say"})")),
               std::runtime_error);
}

}  // namespace
}  // namespace navcal::validation::testing
