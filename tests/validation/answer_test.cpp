// SPDX-License-Identifier: Apache-2.0
#include "validation/answer.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace navcal::cli {
namespace {

constexpr std::string_view kExplained = R"({
  "verdict": "explained",
  "where": [{"channel": "compass.field", "regime": "motor_current", "gap": 2.1, "unit": "uT", "floor": 0.15,
             "p_value": 1e-9}, {"channel": "compass.heading", "regime": "heading", "gap": 1, "unit": "deg",
             "floor": 0.2, "p_value": 0.01}],
  "effects": [{"name": "adc_droop", "probability": 0.6, "parameters": {"per_A": 0.001}, "confused_with": []},
              {"name": "motor_field", "probability": 0.99, "parameters": {"x_uT_per_A": 1.5, "y_uT_per_A": -0.2},
               "std_errors": {"x_uT_per_A": 0.1},
               "confused_with": [{"name": "hard_iron", "tie_breaker": "change shaft speed"}]}],
  "candidates": [{"name": "fin_lag", "probability": 0.07}],
  "gap": {"before": 3, "after": 1.1, "floor": 1, "closed": 0.95, "closed_ci": [0.9, 1.02], "unit": "noise power",
          "channels": []},
  "sources": [{"source": "compass.field", "gain_nats": 40, "errors": []}, {"source": "imu.gyro", "errors": []}],
  "proposal": {"errors": [{"families": ["constant"]}, {"families": ["rate", "speed"]}]},
  "unexplained": [], "seconds": 4.5})";

TEST(GapTrialAnswer, ReadsWhatIsScored) {
  const validation::TrialAnswer answer = validation::read_answer(kExplained);
  EXPECT_EQ(answer.verdict, validation::TrialVerdict::explained);
  EXPECT_EQ(answer.channels, (std::vector<std::string>{"compass.field", "compass.heading"}));
  EXPECT_EQ(answer.sources, (std::vector<std::string>{"compass.field", "imu.gyro"}));
  EXPECT_EQ(answer.families, (std::vector<std::string>{"rate", "speed"}));  // the constant part says nothing
  ASSERT_EQ(answer.effects.size(), 2U);
  EXPECT_EQ(answer.effects[0].name, "motor_field");  // the more probable first
  EXPECT_EQ(answer.effects[0].parameters.at("x_uT_per_A").value, 1.5);
  EXPECT_EQ(answer.effects[0].parameters.at("x_uT_per_A").std_error, 0.1);
  EXPECT_FALSE(answer.effects[0].parameters.at("y_uT_per_A").std_error);
  EXPECT_EQ(answer.candidates.at(0).name, "fin_lag");
  EXPECT_EQ(answer.twins, std::vector<std::string>{"hard_iron"});
  EXPECT_EQ(answer.closed, 0.95);
  EXPECT_EQ(answer.closed_ci, (std::array{0.9, 1.02}));
  EXPECT_EQ(answer.seconds, 4.5);
}

TEST(GapTrialAnswer, WhatCannotBeSaidIsNull) {
  const validation::TrialAnswer answer = validation::read_answer(
      R"({"verdict":"no-gap","where":[],"effects":[],"gap":{"closed":null,"closed_ci":null},"unexplained":[]})");
  EXPECT_EQ(answer.verdict, validation::TrialVerdict::no_gap);
  EXPECT_FALSE(answer.closed);
  EXPECT_FALSE(answer.closed_ci);
  EXPECT_TRUE(answer.sources.empty());
  EXPECT_TRUE(answer.families.empty());
}

TEST(GapTrialAnswer, WhatIsMalformedIsRefusedWithTheReason) {
  struct Refusal {
    const char* json;
    const char* said;
  };
  for (const auto& [json, said] : std::vector<Refusal>{
           {"", "malformed"},
           {"Segmentation fault", "parse error"},
           {"[]", "malformed"},
           {R"({"verdict":"perhaps"})", "no verdict \"perhaps\""},
           {R"({"verdict":"unknown","effects":[],"gap":{}})", "'where' not found"},
           {R"({"verdict":"unknown","where":[],"effects":[],"gap":{"closed":"all"}})", "closed is not a number"},
           {R"({"verdict":"unknown","where":[],"effects":[],"gap":{"closed_ci":[1]}})", "malformed"},
           {R"({"verdict":"explained","where":[],"effects":[],"gap":{}})", "explained, yet no effect is named"},
           {R"({"verdict":"no-gap","where":[],"effects":[{"name":"fin_lag","probability":1}],"gap":{}})",
            "no-gap, yet fin_lag is named"},
           {R"({"verdict":"explained","where":[],"effects":[{"name":"fin_lag","probability":1},)"
            R"({"name":"fin_lag","probability":1}],"gap":{}})",
            "fin_lag is named twice"},
           {R"({"verdict":"explained","where":[],"effects":[{"name":"fin_lag","probability":1.5}],"gap":{}})",
            "probability of fin_lag does not lie between 0 and 1"},
           {R"({"verdict":"explained","where":[],"effects":[{"name":"fin_lag","probability":"1"}],"gap":{}})",
            "must be number"}}) {
    try {
      (void)validation::read_answer(json);
      ADD_FAILURE() << json;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace navcal::cli
