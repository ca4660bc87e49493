// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/live/commands.h"
#include "tests/cli/command_outcome.h"
#include "tests/cli/simulated_recording.h"
#include "tests/record/temporary_folder.h"

namespace navcal::cli {
namespace {

/// Straight ahead with two dives to 2 m: from 60 to 120 s and from 180 to 220 s.
std::vector<sim::PathRow> diving_path() {
  auto rows = test::straight_path(280);
  for (sim::PathRow& row : rows) {
    const bool under = (row.t_s > 60 && row.t_s < 120) || (row.t_s > 180 && row.t_s < 220);
    row.position_m[2] = under ? 2 : 0;
  }
  return rows;
}

class LogSurfacings : public record::testing::TemporaryFolder {
 protected:
  std::string recording(const test::RecordingOptions& options = {.duration_s = 280}) {
    return write("dives.cap", test::simulated_recording(diving_path(), options)).string();
  }
  static test::Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"log", "surfacings"});
    return test::run_command(test::add_log_of_files, std::move(arguments));
  }
};

TEST_F(LogSurfacings, MeasuresEachDive) {
  const auto outcome = run({"--json", recording()});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const auto json = nlohmann::json::parse(outcome.output);
  ASSERT_EQ(json["surfacings"].size(), 2U) << outcome.output;
  const double under_s[] = {60, 40};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& found = json["surfacings"][i];
    EXPECT_NEAR(found["submerged_s"].get<double>(), under_s[i], 1);
    EXPECT_NEAR(found["deepest_m"].get<double>(), 2, 0.2);
    // The emulated receiver searches 2 to 10 s from the first second after surfacing.
    EXPECT_GE(found["ttff_s"].get<double>(), 1.5);
    EXPECT_LE(found["ttff_s"].get<double>(), 12);
    EXPECT_GT(found["without_fix_s"].get<double>(), found["submerged_s"].get<double>());
    EXPECT_GT(found["std_m"].get<double>(), 0);
    EXPECT_LT(found["error_m"].get<double>(), 4 * found["std_m"].get<double>());
    EXPECT_GE(found["tracked"].get<int>(), 3);
  }
  EXPECT_EQ(json["statistics"]["count"], 2);
  EXPECT_EQ(json["statistics"]["with_ttff"], 2);
}

TEST_F(LogSurfacings, WritesATableAndAPage) {
  const auto page = (path_ / "page.html").string();
  const auto outcome = run({"--report", page, recording()});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_NE(outcome.output.find("TTFF, s"), std::string::npos);
  EXPECT_NE(outcome.output.find("2 surfacings."), std::string::npos) << outcome.output;
  const std::string html = read(page);
  for (const char* text :
       {"Time to first fix against time under water", "Error of the dead reckoning", "model, mean"})
    EXPECT_NE(html.find(text), std::string::npos) << text;
}

TEST_F(LogSurfacings, WithoutADepthGaugeTheTimeOfSurfacingIsNotKnown) {
  const auto file = recording({.duration_s = 280, .imu = false});
  const auto json = nlohmann::json::parse(run({"--json", file}).output);
  ASSERT_EQ(json["surfacings"].size(), 2U);
  EXPECT_TRUE(json["surfacings"][0]["ttff_s"].is_null());
  EXPECT_TRUE(json["statistics"]["ttff_median_s"].is_null());
  EXPECT_NE(run({file}).output.find("not known for 2"), std::string::npos);
}

TEST_F(LogSurfacings, ARecordingWithoutDivesHasNone) {
  const auto file =
      write("flat.cap", test::simulated_recording(test::straight_path(60), {.duration_s = 60})).string();
  EXPECT_EQ(run({file}).output, "0 surfacings.\n");
  EXPECT_EQ(run({(path_ / "absent.cap").string()}).status, 3);
  EXPECT_EQ(run({"--report", file, file}).status, 2) << "the page would destroy the recording";
}

}  // namespace
}  // namespace navcal::cli
