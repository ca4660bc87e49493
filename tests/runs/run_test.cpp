// SPDX-License-Identifier: Apache-2.0
#include "runs/run.h"

#include <gtest/gtest.h>

#include "tests/runs/four_thrusters.h"

namespace navcal::runs {
namespace {

std::string good_run_text() { return test::run_text(test::make_run({}, 1)); }

std::string run_refusal(const std::string& text) {
  try {
    static_cast<void>(read_run(text, "r1", "r1.csv"));
  } catch (const BadRun& error) {
    return error.what();
  }
  return "";
}

/// The text with the cell of a line (1 is the heading) and of a column (from 0) replaced.
std::string with_cell(std::string text, int line, int column, const std::string& cell) {
  std::size_t at = 0;
  for (int i = 1; i < line; ++i) at = text.find('\n', at) + 1;
  for (int i = 0; i < column; ++i) at = text.find(',', at) + 1;
  return text.replace(at, text.find_first_of(",\n", at) - at, cell);
}

TEST(RunFile, IsReadAsItWasWritten) {
  const runs::Run made = test::make_run({}, 1, "r1");
  const runs::Run read = read_run(test::run_text(made), "r1", "r1.csv");
  EXPECT_EQ(read.name, "r1");
  ASSERT_EQ(read.rows(), made.rows());
  EXPECT_TRUE(read.command_us.isApprox(made.command_us));
  EXPECT_TRUE(read.clock_s.isApprox(made.clock_s));
  EXPECT_LT((read.depth_m - made.depth_m).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((read.roll_rad - made.roll_rad).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((read.yaw_rate_rad_s - made.yaw_rate_rad_s).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(RunFile, MayHaveOtherLineEndsAMarkAndEmptyLines) {
  std::string text = good_run_text();
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  EXPECT_EQ(run_refusal("\xEF\xBB\xBF" + text + "\r\n\r\n"), "");
}

TEST(RunFile, SecondsMayPassFiftyNine) { EXPECT_EQ(run_refusal(with_cell(good_run_text(), 2, 0, "20289")), ""); }

TEST(RunFile, NamesFileLineAndColumnOfABadCell) {
  EXPECT_EQ(run_refusal(with_cell(good_run_text(), 5, 5, "deep")),
            "r1.csv:5: column depth: \"deep\" is not a number");
  EXPECT_EQ(run_refusal(with_cell(good_run_text(), 7, 16, "nan")),
            "r1.csv:7: column w_yaw: \"nan\" is not a number");
  EXPECT_EQ(run_refusal(with_cell(good_run_text(), 3, 2, "")), "r1.csv:3: column pwm2: \"\" is not a number");
  EXPECT_EQ(run_refusal(with_cell(good_run_text(), 3, 6, "1e30")), "r1.csv:3: column press: 1e30 is out of range");
  EXPECT_EQ(run_refusal(with_cell(good_run_text(), 2, 0, "-3")), "r1.csv:2: column time: -3 is not HHMMSS");
}

TEST(RunFile, NamesAMissingOrDoubledColumn) {
  EXPECT_EQ(run_refusal(with_cell(good_run_text(), 1, 5, "deepness")),
            "r1.csv:1: column depth: missing in the heading");
  EXPECT_EQ(run_refusal(with_cell(good_run_text(), 1, 1, "thrust")),
            "r1.csv:1: column pwm1: missing in the heading");
  EXPECT_EQ(run_refusal(with_cell(good_run_text(), 1, 10, "roll")), "r1.csv:1: column roll: twice in the heading");
}

TEST(RunFile, RefusesRowsOfOtherLengthAndShortRuns) {
  EXPECT_EQ(run_refusal(with_cell(good_run_text(), 4, 3, "1,2")),
            "r1.csv:4: 18 columns, where the heading has 17");
  EXPECT_EQ(run_refusal(good_run_text().substr(0, 2000)).find("r1.csv:"), 0U);
  EXPECT_NE(run_refusal(""), "");
  test::Trait brief;
  brief.seconds = 3;
  EXPECT_EQ(run_refusal(test::run_text(test::make_run(brief, 1))), "r1.csv: 60 rows; a run needs 100");
}

}  // namespace
}  // namespace navcal::runs
