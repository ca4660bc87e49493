// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "analysis/thesis/thesis_parts.h"
#include "analysis/thesis/thesis_results.h"
#include "base/angles.h"
#include "base/failure.h"
#include "config/error.h"
#include "sim/path.h"
#include "tests/support/temporary_folder.h"

namespace navcal::analysis {
namespace {

using calib::thesis::kTrueBias_rad_s;
using calib::thesis::kTrueScale;

ThesisRequest small_request(std::uint64_t seed) { return {NAVCAL_SOURCE_DIR "/fixtures/paths", 2, seed}; }

const ThesisResults& small_results() {
  static const ThesisResults results = thesis_results(small_request(1), [](std::string_view, double) {});
  return results;
}

/// The numbers that tests/calib/thesis expects of the algorithms themselves.
TEST(ThesisRun, TheAlgorithmsOfTheThesisGiveTheirNumbers) {
  constexpr double kLeastSquares[8][2] = {{3.19, 13.66}, {0.71, 0.96}, {0.57, 0.51},  {0.31, 0.11},
                                          {2.16, 0.76},  {1.47, 0.27}, {2.24, 25.29}, {2.44, 5.36}};
  constexpr double kAdaptive[8][2] = {{-143.69, 561.47}, {3.08, 9.31}, {-0.64, 0.15},     {-1.41, -0.87},
                                      {-3.32, 39.43},    {1.29, 2.91}, {-102.62, 803.18}, {-136.32, 296.83}};
  constexpr double kCompass_deg[8][2] = {{2.25, 1.11}, {1.83, 0.83}, {2.48, 1.08},  {3.37, 1.49},
                                         {6.13, 3.43}, {8.38, 4.54}, {11.40, 6.01}, {0.89, 0.44}};
  for (std::size_t i = 0; i < 8; ++i) {
    const ThesisGyro& gyro = small_results().gyro.at(i);
    EXPECT_NEAR(100 * std::abs(gyro.least_squares[0] / kTrueScale - 1), kLeastSquares[i][0], 0.0051) << i + 1;
    EXPECT_NEAR(100 * std::abs(gyro.least_squares[1] / kTrueBias_rad_s - 1), kLeastSquares[i][1], 0.0051) << i + 1;
    EXPECT_NEAR(100 * (gyro.adaptive[0] / kTrueScale - 1), kAdaptive[i][0], 0.0051) << i + 1;
    EXPECT_NEAR(-100 * (gyro.adaptive[1] / kTrueBias_rad_s - 1), kAdaptive[i][1], 0.0051) << i + 1;
    const auto& compass = small_results().compass.at(i).least_squares_error;
    EXPECT_NEAR(compass.largest_deg, kCompass_deg[i][0], 0.0051) << i + 1;
    EXPECT_NEAR(compass.std_deg, kCompass_deg[i][1], 0.0051) << i + 1;
  }
}

TEST(ThesisRun, NavcalReachesItsGoalsWithoutNoise) {
  for (std::size_t i = 0; i < 8; ++i) {
    const ThesisGyro& gyro = small_results().gyro.at(i);
    EXPECT_NEAR(gyro.navcal[0] / kTrueScale, 1, 0.005 / 100) << i + 1;
    EXPECT_NEAR(gyro.navcal[1] / kTrueBias_rad_s, 1, 0.02 / 100) << i + 1;
    EXPECT_LT(small_results().compass.at(i).navcal_error.largest_deg, 0.03) << i + 1;
    EXPECT_TRUE(gyro.navcal_settled_s) << i + 1;
  }
}

TEST(ThesisRun, TheMagnetometerLeavesWhatItsSamplingLeaves) {
  const auto& circles = small_results().circles;
  for (std::size_t row = 0; row < 4; ++row) {
    EXPECT_NEAR(circles.at(row).residual_deg, 0.085, 0.01) << row;
    EXPECT_LT(circles.at(row).navcal_deg, 0.001) << row;
  }
  EXPECT_NEAR(circles[1].raw_deg[0], -8.13, 0.01);
  EXPECT_NEAR(circles[1].raw_deg[1], 8.13, 0.01);
  // As on the axis of figure 4.11, -15 to 15 degrees, the negative error is the larger one: -12.4 and 10.3.
  EXPECT_NEAR(circles[3].raw_deg[0], -12.4, 0.05);
  EXPECT_NEAR(circles[3].raw_deg[1], 10.3, 0.05);
  EXPECT_NEAR(small_results().field_paths[0][3].thesis_deg, 49.46, 0.02);
  EXPECT_NEAR(small_results().field_paths[1][6].thesis_deg, 1.26, 0.02);
}

TEST(ThesisRun, FiguresStayWithinTheAxesOfTheThesis) {
  for (const ThesisTurnTrace& trace : small_results().turn_traces) {
    if (trace.noisy || trace.path < 2 || trace.path > 4) continue;
    for (const double error : trace.least_squares.rate_rad_s) EXPECT_LE(std::abs(error), 0.004) << trace.path;
    for (const double error : trace.least_squares.heading_rad) EXPECT_LE(std::abs(error), 0.04) << trace.path;
  }
}

TEST(ThesisRun, ASeedGivesItsNumbersAgainAndAnotherSeedOthers) {
  const ThesisPath path = load_thesis_path(NAVCAL_SOURCE_DIR "/fixtures/paths/path3.csv");
  const ThesisGyro a = thesis_gyro_result(path, 2, 5), b = thesis_gyro_result(path, 2, 5);
  EXPECT_EQ(a.navcal_rms, b.navcal_rms);
  EXPECT_EQ(a.least_squares_rms, b.least_squares_rms);
  EXPECT_NE(a.navcal_rms, thesis_gyro_result(path, 2, 6).navcal_rms);
}

TEST(ThesisRun, ProgressGoesFromZeroUpwards) {
  std::vector<double> shares;
  (void)thesis_results(small_request(2), [&](std::string_view, double done) { shares.push_back(done); });
  ASSERT_FALSE(shares.empty());
  EXPECT_EQ(shares.front(), 0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_LT(shares.back(), 1);
}

TEST(ThesisSettled, CountsFromTheLastTimeThatEitherComesClose) {
  const double s = kTrueScale, b = kTrueBias_rad_s;
  const std::vector<double> time_s{0, 1, 2, 3};
  EXPECT_EQ(thesis_settled_s(time_s, {s, s, s, s}, {b, b, b, b}), 0);
  EXPECT_EQ(thesis_settled_s(time_s, {s, 2, s, s}, {b, b, b, b}), 2);
  EXPECT_EQ(thesis_settled_s(time_s, {s, s, s, s}, {b, b, 0, b}), 3);
  EXPECT_EQ(thesis_settled_s(time_s, {s, s, s, s}, {b, b, b, 0}), std::nullopt);
  EXPECT_EQ(thesis_settled_s(time_s, {}, {}), std::nullopt);
}

std::string failure_of(const std::filesystem::path& folder) {
  try {
    (void)load_thesis_paths(folder);
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.status(), base::Exit::bad_input);
    return failure.what();
  } catch (const config::Error& bad) {
    return bad.what();
  }
  return "none";
}

TEST(ThesisPaths, AMissingOrWrongPathIsNamed) {
  test::TemporaryFolder folder;
  EXPECT_NE(failure_of(folder.path()).find("path1.csv"), std::string::npos);
  const std::string head = "t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3\n";
  const auto write = [&](double period_s, int rows) {
    std::ofstream file(folder / "path1.csv");
    file << head;
    for (int i = 0; i < rows; ++i) file << i * period_s << ",0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n";
  };
  write(0.05, 200);
  EXPECT_NE(failure_of(folder.path()).find("path1.csv:3: rows must be 0.1 s apart"), std::string::npos);
  write(0.1, 3);
  EXPECT_NE(failure_of(folder.path()).find("3 rows are too few"), std::string::npos);
  write(0.1, 200);
  EXPECT_NE(failure_of(folder.path()).find("path2.csv"), std::string::npos);
}

}  // namespace
}  // namespace navcal::analysis
