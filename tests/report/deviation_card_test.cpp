// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "base/angles.h"
#include "report/calibrate_figures.h"

namespace navcal::report {
namespace {

calib::Report report_of(bool is_accepted) {
  calib::Report report;
  report.estimates.compass = calib::DeviationCorrection{{0, 0.1, 0, 0, 0}};  // B: by the sine of the heading
  calib::CalibratorReport compass;
  compass.calibrator = calib::Calibrator::compass;
  compass.judgement.accepted = is_accepted;
  compass.covariance = 1e-4 * Eigen::Matrix4d::Identity();
  report.calibrators.push_back(compass);
  return report;
}

TEST(DeviationCard, HasARowForEachThirtyDegreesWhoseNumbersAgree) {
  const calib::Report report = report_of(true);
  const auto card = deviation_card(report);
  ASSERT_EQ(card.size(), 12U);
  for (std::size_t i = 0; i < card.size(); ++i) {
    ASSERT_EQ(card[i].size(), 4U);
    const double shown = std::stod(card[i][0]), deviation = std::stod(card[i][1]),
                 magnetic = std::stod(card[i][3]);
    EXPECT_EQ(shown, 30.0 * static_cast<double>(i));
    EXPECT_NEAR(std::remainder(shown - deviation - magnetic, 360), 0, 0.11);
    const double corrected_rad = (*report.estimates.compass)(shown / base::kDegreesPerRadian);
    EXPECT_NEAR(std::remainder(magnetic - corrected_rad * base::kDegreesPerRadian, 360), 0, 0.06);
    EXPECT_NEAR(std::stod(card[i][2]), 2 * 0.01 * std::sqrt(2.0) * base::kDegreesPerRadian, 0.06);
  }
  EXPECT_EQ(card[1][0], "030");
  EXPECT_GT(std::abs(std::stod(card[3][1])), 5) << "at east";
}

TEST(DeviationCard, WithoutAnAcceptedCalibrationThereIsNone) {
  EXPECT_TRUE(deviation_card(report_of(false)).empty());
  EXPECT_TRUE(deviation_card({}).empty());
}

}  // namespace
}  // namespace navcal::report
