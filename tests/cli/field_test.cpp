// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/command_outcome.h"

namespace navcal::cli {
namespace {

test::Outcome run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "field");
  return test::run_command(add_field, std::move(arguments));
}

// A row of the published test values: 2025.0, 48 km, 80 north, 96 west.
TEST(FieldCommand, AnswersThePublishedField) {
  const auto outcome = run({"--place", "80,-96,48000", "--date", "2025-01-01", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const auto json = nlohmann::json::parse(outcome.output);
  EXPECT_NEAR(json["field_uT"][0], 1.87598, 6e-5);
  EXPECT_NEAR(json["field_uT"][1], -1.07927, 6e-5);
  EXPECT_NEAR(json["field_uT"][2], 55.62304, 6e-5);
  EXPECT_NEAR(json["declination_deg"], -29.91, 0.006);
  EXPECT_NEAR(json["dip_deg"], 87.77, 0.006);
  EXPECT_EQ(json["valid"], true);
}

TEST(FieldCommand, TheTextIsATableOfTheConfiguration) {
  const auto outcome = run({"--place", "59.33,18.07", "--date", "2026-06-01"});
  EXPECT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_NE(outcome.output.find("[environment]\ndeclination_deg = 7."), std::string::npos) << outcome.output;
}

TEST(FieldCommand, WhatIsNoPlaceOrDayIsToldWithWhatIsWanted) {
  for (const char* const place : {"59.33", "59.33,", "a,b", "91,0", "10,361", "1,2,3,4", "", "59.33;18.07"}) {
    const auto outcome = run({"--place", place});
    EXPECT_EQ(outcome.status, 2) << place;
  }
  for (const char* const date : {"2026", "2026-13-01", "2026-02-30", "yesterday", "2026-01-01x"}) {
    const auto outcome = run({"--place", "1,2", "--date", date});
    EXPECT_EQ(outcome.status, 2) << date;
    EXPECT_NE(outcome.message.find("YYYY-MM-DD"), std::string::npos) << outcome.message;
  }
}

TEST(FieldCommand, AYearBeyondTheModelIsMarked) {
  const auto outcome = run({"--place", "1,2", "--date", "2035-01-01", "--json"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(nlohmann::json::parse(outcome.output)["valid"], false);
}

}  // namespace
}  // namespace navcal::cli
