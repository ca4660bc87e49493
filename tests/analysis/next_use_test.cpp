// SPDX-License-Identifier: Apache-2.0
#include "analysis/next_use.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace navcal::analysis {
namespace {

using calib::Calibrator;

/// One accepted estimate.
calib::Report report_of(Calibrator calibrator, std::vector<calib::Quantity> estimate) {
  calib::Report report;
  calib::CalibratorReport& one = report.calibrators.emplace_back();
  one.calibrator = calibrator;
  one.judgement.accepted = true;
  one.estimate = std::move(estimate);
  return report;
}

calib::Report scale_of(double value, double std) { return report_of(Calibrator::gyro, {{"scale", value, std}}); }

double next_scale(calib::Report whole, const std::vector<calib::Report>& parts) {
  add_next_use(whole, parts, {});
  return whole.calibrators.front().estimate.front().next_std;
}

TEST(NextUse, PartsThatAgreeAddNothing) {
  EXPECT_DOUBLE_EQ(next_scale(scale_of(1, 0.01), {scale_of(1.001, 0.02), scale_of(0.999, 0.02)}), 0.01);
}

TEST(NextUse, PartsThatDisagreeAddTheirScatter) {
  // Three parts: Student's point for two degrees of freedom is 4.303.
  const double expected = std::hypot(0.01, 0.1 * std::sqrt(1 + 1.0 / 3) * 4.30265 / 2);
  EXPECT_NEAR(next_scale(scale_of(1, 0.01), {scale_of(0.9, 0), scale_of(1, 0), scale_of(1.1, 0)}), expected, 1e-5);
}

TEST(NextUse, FewerThanTwoAcceptedPartsTellNothing) {
  calib::Report refused = scale_of(5, 0.01);
  refused.calibrators.front().judgement.accepted = false;
  EXPECT_TRUE(std::isnan(next_scale(scale_of(1, 0.01), {})));
  EXPECT_TRUE(std::isnan(next_scale(scale_of(1, 0.01), {scale_of(1, 0.01), refused})));
  const double unknown = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(next_scale(scale_of(1, 0.01), {scale_of(1, 0.01), scale_of(1, unknown)})));
}

TEST(NextUse, AnglesAreComparedAcrossNorth) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto offset = [](double rad) { return report_of(Calibrator::misalignment, {{"A_rad", rad, 0.01}}); };
  EXPECT_DOUBLE_EQ(next_scale(offset(0.001), {offset(0.002), offset(kTurn - 0.002)}), 0.01);
}

TEST(NextUse, AWorstHeadingComesFromTheIronOfTheParts) {
  const auto iron = [](double x_uT) {
    calib::Report report = report_of(Calibrator::magnetometer, {{"worst_heading_rad", 0, 0.001}});
    report.estimates.magnetometer = calib::FieldCorrection{{x_uT, 0, 0}, Eigen::Matrix3d::Identity()};
    return report;
  };
  pipeline::EarthField field;
  field.size_uT = 20;  // level
  calib::Report whole = iron(0);
  const std::vector<calib::Report> parts{iron(-1), iron(1)};
  add_next_use(whole, parts, field);
  // 1 uT to both sides is 0.05 rad each at east and west: their scatter is 0.0707 rad.
  const double expected = std::hypot(0.001, 0.0707 * std::sqrt(1.5) * 12.706 / 2);
  EXPECT_NEAR(whole.calibrators.front().estimate.front().next_std, expected, 1e-3);
  EXPECT_EQ(whole.parts, 2U);
}

}  // namespace
}  // namespace navcal::analysis
