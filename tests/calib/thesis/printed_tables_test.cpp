// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/printed_tables.h"

#include <gtest/gtest.h>

#include "base/angles.h"
#include "calib/thesis/algorithm_runs.h"
#include "calib/thesis/distorted_field.h"

/// The tables as printed agree with themselves: a slip of the transcription shows here.
namespace navcal::calib::thesis {
namespace {

TEST(PrintedTables, PercentagesOfTheGyroFollowFromTheEstimates) {
  for (const auto* table : {&kTable3_1, &kTable3_2}) {
    for (const PrintedGyro& row : *table) {
      // The thesis takes the true values as 1.1111 and -0.1111.
      EXPECT_NEAR(100 * (row.scale - 1.1111) / 1.1111, row.scale_percent, 0.0051) << row.scale;
      EXPECT_NEAR(100 * (row.bias_rad_s + 0.1111) / 0.1111, row.bias_percent, 0.0051) << row.bias_rad_s;
    }
  }
}

TEST(PrintedTables, PercentagesOfTheCompassHaveTheSignOfTheTruth) {
  const double truth_deg[4] = {5, -5, 2, 2};
  for (const PrintedCompass& row : kTable4_1) {
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(100 * (row.deviation_deg.at(i) - truth_deg[i]) / truth_deg[i], row.percent.at(i), 0.0101)
          << row.deviation_deg.at(i);
  }
}

TEST(PrintedTables, HeadingErrorsOfTable4_1FollowFromItsCoefficients) {
  for (const PrintedCompass& row : kTable4_1) {
    const HeadingStatistics found =
        table_4_1_statistics(Eigen::Vector4d(row.deviation_deg.data()) * base::kRadiansPerDegree);
    EXPECT_NEAR(found.mean_deg, row.mean_deg, 0.0002);
    EXPECT_NEAR(found.largest_deg, row.largest_deg, 0.0002);
    EXPECT_NEAR(found.std_deg, row.std_deg, 0.0002);
  }
}

TEST(PrintedTables, TheMetricOfTable4_1HasAFloor) {
  const HeadingStatistics perfect = table_4_1_statistics(thesis_deviation().tail<4>());
  EXPECT_NEAR(perfect.mean_deg, 0.0232, 0.0001);
  EXPECT_NEAR(perfect.largest_deg, 1.0384, 0.0001);
  EXPECT_NEAR(perfect.std_deg, 0.4990, 0.0001);
}

TEST(PrintedTables, TheCirclesOfTable4_2AreThoseOfTheFigures) {
  const auto circle = [](const PrintedCircle& row) {
    return distorted_circle({{row.shift_x_uT, row.shift_y_uT}, row.eccentricity, row.axis_deg});
  };
  EXPECT_EQ(circle(kTable4_2[3]).axes_uT, figure_4_11().axes_uT);
  EXPECT_EQ(circle(kTable4_2[4]).axes_uT, figure_4_12().axes_uT);
  EXPECT_EQ(circle(kTable4_2[4]).centre_uT, figure_4_12().centre_uT);
  // No distortion: a circle about zero.
  EXPECT_NEAR((circle(kTable4_2[0]).axes_uT - kCircle_uT * Eigen::Matrix2d::Identity()).norm(), 0, 1e-12);
}

TEST(DistortedField, AxesAreThoseOfTheEccentricity) {
  // Axis forward: the field forward keeps its size, the one to starboard shrinks by sqrt(1 - 0.6^2).
  const EllipseShape shape = distorted_circle({{1, 2}, 0.6, 0});
  EXPECT_NEAR((shape.at(0) - Eigen::Vector2d(21, 2)).norm(), 0, 1e-12);
  EXPECT_NEAR((shape.at(base::kTurn_rad / 4) - Eigen::Vector2d(1, 2 - 16)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace navcal::calib::thesis
