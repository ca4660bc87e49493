// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/angles.h"
#include "calib/thesis/adaptive_identifier.h"
#include "calib/thesis/distorted_field.h"
#include "calib/thesis/heading_least_squares.h"
#include "tests/calib/thesis_paths.h"

/// The algorithms of the thesis (Mach 2003) give on our paths what another implementation of them gave.
namespace navcal::calib::thesis {
namespace {

using namespace test;

double factor(const TruePoint& p) { return std::cos(p.roll_rad) / std::cos(p.pitch_rad); }
double measured_rate(const TruePoint& p) { return (p.rate_rad_s.z() - kTrueBias_rad_s) / kTrueScale; }
std::string name(int path) { return "path" + std::to_string(path + 1); }

TEST(Thesis, GyroLeastSquaresOfTable11_1) {
  constexpr double kPercent[8][2] = {{3.19, 13.66}, {0.71, 0.96}, {0.57, 0.51},  {0.31, 0.11},
                                     {2.16, 0.76},  {1.47, 0.27}, {2.24, 25.29}, {2.44, 5.36}};
  for (int i = 0; i < 8; ++i) {
    GyroLeastSquares estimator(kPeriod_s);
    for (const auto& p : load_true_path(name(i))) {
      estimator.update(p.heading_rad, p.roll_rad, p.pitch_rad, measured_rate(p));
    }
    const auto found = estimator.estimate();
    ASSERT_TRUE(found);
    EXPECT_NEAR(100 * std::abs((*found)[0] / kTrueScale - 1), kPercent[i][0], 0.0051) << i + 1;
    EXPECT_NEAR(100 * std::abs((*found)[1] / kTrueBias_rad_s - 1), kPercent[i][1], 0.0051) << i + 1;
  }
}

TEST(Thesis, GyroLeastSquaresWithoutTurnFindsNothing) {
  GyroLeastSquares estimator(kPeriod_s);
  for (int i = 0; i < 100; ++i) estimator.update(1, 0, 0, 0.1);
  EXPECT_FALSE(estimator.estimate());
}

TEST(Thesis, AdaptiveIdentifierBelowTable11_1) {
  constexpr double kPercent[8][2] = {{-143.69, 561.47}, {3.08, 9.31}, {-0.64, 0.15},     {-1.41, -0.87},
                                     {-3.32, 39.43},    {1.29, 2.91}, {-102.62, 803.18}, {-136.32, 296.83}};
  for (int i = 0; i < 8; ++i) {
    AdaptiveIdentifier identifier(kPeriod_s);
    for (const auto& p : load_true_path(name(i))) {
      identifier.update(p.heading_rad, p.roll_rad, p.pitch_rad, measured_rate(p));
    }
    EXPECT_NEAR(100 * (identifier.estimate()[0] / kTrueScale - 1), kPercent[i][0], 0.0051) << i + 1;
    // Percent of the absolute value: positive is less negative.
    EXPECT_NEAR(-100 * (identifier.estimate()[1] / kTrueBias_rad_s - 1), kPercent[i][1], 0.0051) << i + 1;
  }
}

TEST(Thesis, CompassLeastSquaresOfTable11_2) {
  constexpr double kDegrees[8][2] = {{2.25, 1.11}, {1.83, 0.83}, {2.48, 1.08},  {3.37, 1.49},
                                     {6.13, 3.43}, {8.38, 4.54}, {11.40, 6.01}, {0.89, 0.44}};
  const Deviation truth = thesis_deviation();
  for (int i = 0; i < 8; ++i) {
    CompassLeastSquares estimator(kPeriod_s);
    for (const auto& p : load_true_path(name(i))) {
      // The thesis's own injection, E = true minus measured at the true heading (THESIS 0.3).
      estimator.update(p.heading_rad - deviation_rad(truth, p.heading_rad), factor(p) * p.rate_rad_s.z());
    }
    const auto found = estimator.estimate();
    ASSERT_TRUE(found);
    Deviation correction = Deviation::Zero();
    correction.tail<4>() = -*found;  // added by the thesis, subtracted in (2.8)
    double largest = 0, sum = 0, square = 0;
    constexpr int kPoints = 629;
    for (int k = 0; k < kPoints; ++k) {
      const double psi = 0.01 * k, measured = psi - deviation_rad(truth, psi);
      const double error = (psi - measured - deviation_rad(correction, measured)) / base::kRadiansPerDegree;
      largest = std::max(largest, std::abs(error));
      sum += error;
      square += error * error;
    }
    EXPECT_NEAR(largest, kDegrees[i][0], 0.0051) << i + 1;
    EXPECT_NEAR(std::sqrt((square - sum * sum / kPoints) / (kPoints - 1)), kDegrees[i][1], 0.0051) << i + 1;
  }
}

struct Distortion {
  Eigen::Vector2d shift_uT;
  double eccentricity, axis_deg;
};

Eigen::Vector2d distorted(const Distortion& d, double heading_rad) {
  const Eigen::Rotation2Dd rotation(d.axis_deg * base::kRadiansPerDegree);
  const Eigen::Vector2d level = 20 * Eigen::Vector2d(std::cos(heading_rad), -std::sin(heading_rad));
  const Eigen::Vector2d axes(1, std::sqrt(1 - d.eccentricity * d.eccentricity));
  return rotation * axes.asDiagonal() * (rotation.inverse() * level) + d.shift_uT;
}

double largest_residual_deg(const CircleMoments& moments, const Distortion& d) {
  double largest = 0;
  for (int k = 0; k < 3600; ++k) {
    const double psi = k * base::kRadiansPerDegree / 10;
    const Eigen::Vector2d field = moments.matrix * (distorted(d, psi) - moments.centre_uT);  // (4.18)
    largest = std::max(
        largest, std::abs(std::remainder(std::atan2(-field.y(), field.x()) - psi, 360 * base::kRadiansPerDegree)));
  }
  return largest / base::kRadiansPerDegree;
}

TEST(Thesis, MomentsOfAnEvenCircleAreExact) {
  const Distortion figure_4_11{{2, 2}, 0.5, 120};
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < 629; ++k) points.push_back(distorted(figure_4_11, k * 2 * std::numbers::pi / 629));
  const auto moments = CircleMoments::fit(points);
  ASSERT_TRUE(moments);
  EXPECT_LT(largest_residual_deg(*moments, figure_4_11), 0.0003);
}

TEST(Thesis, MomentsOnThePathsOfTable11_4) {
  const Distortion figure_4_11{{2, 2}, 0.5, 120}, figure_4_12{{2, -4}, 0.8, 10};
  constexpr double kDegrees[8][2] = {{12.05, 9.32}, {14.38, 13.56}, {27.69, 32.50}, {49.46, 50.54},
                                     {10.18, 8.17}, {21.89, 27.86}, {1.00, 1.26},   {3.23, 3.59}};
  for (int i = 0; i < 8; ++i) {
    const auto path = load_true_path(name(i));
    int column = 0;
    for (const Distortion& d : {figure_4_11, figure_4_12}) {
      std::vector<Eigen::Vector2d> points;
      for (const auto& p : path) points.push_back(distorted(d, p.heading_rad));
      const auto moments = CircleMoments::fit(points);
      ASSERT_TRUE(moments);
      EXPECT_NEAR(largest_residual_deg(*moments, d), kDegrees[i][column++], 0.02) << i + 1;
    }
  }
}

}  // namespace
}  // namespace navcal::calib::thesis
