// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipse_gyro.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/angles.h"
#include "tests/calib/magnetometer_paths.h"

namespace navcal::calib::test {
namespace {

EllipseGyro::Parameters parameters(bool gyro_known) {
  EllipseGyro::Parameters parameters;
  parameters.noise_uT = Noise{}.field_uT;
  parameters.rate_noise_rad_sqrt_s = Noise{}.rate_rad_s * std::sqrt(0.1);
  if (!gyro_known) return parameters;
  parameters.gyro.mean = {kTrueScale, kTrueBias_rad_s};
  parameters.gyro.covariance = 1e-10 * Eigen::Matrix2d::Identity();
  return parameters;
}

/// Forth and back over an arc at up to 0.3 rad/s.
std::vector<TruePoint> arc(double degrees) {
  std::vector<TruePoint> path;
  const double half = degrees * base::kRadiansPerDegree / 2;
  const double pace = 0.3 / half;
  for (int i = 0; i <= 500; ++i) {
    TruePoint point;
    point.time_s = 0.1 * i;
    point.heading_rad = 1 - half * std::cos(pace * point.time_s);
    point.rate_rad_s.z() = half * pace * std::sin(pace * point.time_s);
    path.push_back(point);
  }
  return path;
}

void feed(EllipseGyro& estimator, const std::vector<FieldReading>& readings) {
  for (const auto& r : readings) estimator.update(r.field_body_uT, r.roll_rad, r.pitch_rad, r.turn);
}

std::string saved(EllipseGyro& estimator) {
  Archive archive;
  archive(estimator);
  return archive.bytes();
}

TEST(EllipseGyro, WithoutNoiseFindsDistortionAndGyroOnEveryPath) {
  for (const bool known : {true, false}) {
    for (int path = 1; path <= 8; ++path) {
      Random random(1);
      EllipseGyro::Parameters wide = parameters(known);
      if (!known) wide.gyro.covariance *= 25;  // so that the belief in a scale of one does not pull
      EllipseGyro estimator(wide);
      const auto truth = figure_4_12();
      feed(estimator, level_field_on(load_true_path("path" + std::to_string(path)), truth, kNoNoise, random));
      estimator.settle();
      ASSERT_TRUE(estimator.estimate()) << path;
      EXPECT_LT(heading_error(estimator.estimate()->correction, truth).largest_deg, 0.02) << path;
      EXPECT_NEAR(estimator.gyro()[0], kTrueScale, 0.01) << path;
    }
  }
}

TEST(EllipseGyro, ShortArcsAsGoodAsTheThesisGoals) {
  // THESIS 11.6: 2.3 degrees at 60, 1.3 at 90, 0.8 at 120; medians, so single runs may be twice as far off.
  Random random(2);
  for (const auto& [degrees, goal_deg] : {std::pair{60., 2.3}, {90., 1.3}, {120., 0.8}}) {
    EllipseGyro estimator(parameters(true));
    feed(estimator, level_field_on(arc(degrees), figure_4_11(), Noise{}, random));
    estimator.settle();
    ASSERT_TRUE(estimator.estimate());
    EXPECT_LT(heading_error(estimator.estimate()->correction, figure_4_11()).largest_deg, 2 * goal_deg) << degrees;
    EXPECT_LT(estimator.estimate()->heading_std_rad, goal_deg * base::kRadiansPerDegree) << degrees;
  }
}

TEST(EllipseGyro, AHullThatHardlyTurnedIsToldToTurnAndByHowMuch) {
  for (const double degrees : {0.2, 1.0, 5.0, 30.0}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      Random random(seed);
      EllipseGyro estimator(parameters(true));
      feed(estimator, level_field_on(arc(degrees), figure_4_11(), Noise{}, random));
      estimator.settle();
      const Judgement judgement = estimator.judgement();
      if (judgement.accepted) continue;
      EXPECT_NE(judgement.manoeuvre, "") << degrees;
      EXPECT_EQ(judgement.manoeuvre.find("through 0 more"), std::string::npos) << judgement.manoeuvre;
    }
  }
}

TEST(EllipseGyro, InSlicesEqualsTheWholeOnItsSummary) {
  Random random(3);
  const auto readings = level_field_on(load_true_path("path4"), figure_4_11(), Noise{}, random);
  auto rarely = parameters(true), often = parameters(true);
  rarely.slice_samples = 100000;
  often.slice_samples = 7;
  EllipseGyro whole(rarely), sliced(often);
  feed(whole, readings);
  feed(sliced, readings);
  ASSERT_TRUE(sliced.shape());
  whole.settle();
  sliced.settle();
  ASSERT_TRUE(whole.shape());
  EXPECT_LT((whole.shape()->centre_uT - sliced.shape()->centre_uT).norm(), 1e-9);
  EXPECT_LT((whole.shape()->axes_uT - sliced.shape()->axes_uT).norm(), 1e-9);
}

TEST(EllipseGyro, RestoredGoesOnBitForBit) {
  Random random(4);
  const auto readings = level_field_on(load_true_path("path2"), figure_4_11(), Noise{}, random);
  EllipseGyro one(parameters(false)), other(parameters(false));
  feed(one, {readings.begin(), readings.begin() + 211});
  const std::string bytes = saved(one);
  Archive archive{std::string_view(bytes)};
  archive(other);
  ASSERT_TRUE(archive.ok() && archive.at_end());
  feed(one, {readings.begin() + 211, readings.end()});
  feed(other, {readings.begin() + 211, readings.end()});
  EXPECT_EQ(saved(one), saved(other));
}

TEST(EllipseGyro, AGyroOtherThanBelievedIsRefused) {
  Random random(5);
  EllipseGyro::Parameters wrong = parameters(true);
  wrong.gyro.mean = {1, 0};
  EllipseGyro estimator(wrong);
  feed(estimator, level_field_on(arc(100), figure_4_11(), Noise{}, random));
  estimator.settle();
  EXPECT_FALSE(estimator.judgement().accepted);
}

TEST(EllipseGyro, NoTurnIsRefused) {
  Random random(6);
  EllipseGyro estimator(parameters(true));
  feed(estimator, level_field_on(arc(4), figure_4_11(), Noise{}, random));
  estimator.settle();
  EXPECT_FALSE(estimator.judgement().accepted);
  EXPECT_FALSE(estimator.judgement().manoeuvre.empty());
}

TEST(EllipseGyro, AnUnknownWayBetweenReadingsIsNotGuessed) {
  Random random(7);
  const auto readings = level_field_on(arc(120), figure_4_11(), Noise{}, random);
  EllipseGyro estimator(parameters(true));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    // Twenty readings in the midst are damaged, with the turns that they tell of.
    const bool damaged = i >= 200 && i < 220;
    const auto& r = readings[i];
    estimator.update(damaged ? Eigen::Vector3d(nan, 0, 0) : r.field_body_uT, 0, 0, r.turn);
  }
  estimator.settle();
  ASSERT_TRUE(estimator.estimate());
  EXPECT_LT(heading_error(estimator.estimate()->correction, figure_4_11()).largest_deg, 2);
}

TEST(EllipseGyro, TheSummaryIsBounded) {
  Random random(8);
  EllipseGyro estimator(parameters(true));
  const auto readings = level_field_on(load_true_path("path7"), figure_4_11(), Noise{}, random);
  for (int i = 0; i < 3; ++i) feed(estimator, readings);
  EXPECT_LE(estimator.groups().size(), EllipseGyro::kCapacity);
  estimator.settle();
  EXPECT_LT(heading_error(estimator.estimate()->correction, figure_4_11()).largest_deg, 0.3);
}

}  // namespace
}  // namespace navcal::calib::test
