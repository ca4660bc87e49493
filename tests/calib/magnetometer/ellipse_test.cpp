// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "calib/magnetometer/ellipse_estimator.h"
#include "calib/magnetometer/ellipse_judgement.h"
#include "tests/calib/magnetometer_paths.h"

namespace navcal::calib::test {
namespace {

EllipseEstimator::Parameters thesis_noise() {
  EllipseEstimator::Parameters parameters;
  parameters.noise_uT = Noise{}.field_uT;
  return parameters;
}

void feed(EllipseEstimator& estimator, const std::vector<FieldReading>& readings) {
  for (const auto& r : readings) estimator.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
}

double apart(const EllipseShape& a, const EllipseShape& b) {
  return std::max((a.centre_uT - b.centre_uT).norm(), (a.axes_uT - b.axes_uT).norm());
}

TEST(Ellipse, WithoutNoiseFindsTheDistortionOnEveryPath) {
  for (int path = 1; path <= 8; ++path) {
    for (const EllipseShape& truth : {figure_4_11(), figure_4_12()}) {
      Random random(1);
      EllipseEstimator estimator(thesis_noise());
      feed(estimator, level_field_on(load_true_path("path" + std::to_string(path)), truth, kNoNoise, random));
      estimator.settle();
      ASSERT_TRUE(estimator.estimate()) << path;
      EXPECT_LT(heading_error(estimator.estimate()->correction, truth).largest_deg, 0.002) << path;
    }
  }
}

TEST(Ellipse, InSlicesEqualsTheWholeOnItsSummary) {
  Random random(2);
  EllipseEstimator sliced(thesis_noise()), whole(thesis_noise());
  const auto readings = level_field_on(load_true_path("path3"), figure_4_12(), Noise{}, random);
  feed(sliced, readings);
  feed(whole, readings);
  whole.settle();
  ASSERT_TRUE(whole.fit() && whole.fit()->settled);
  EllipseFit fit = *sliced.fit();
  for (int i = 0; i < 40; ++i) fit = improve(fit, sliced.cells().cells(), thesis_noise().noise_uT);
  EXPECT_LT(apart(fit.shape, whole.fit()->shape), 1e-9);
}

TEST(Ellipse, CoverageIsTheShareOfTheCircle) {
  for (const double share : {0.6, 0.75, 1.0}) {
    Random random(4);
    std::vector<Attitude> attitudes;
    for (int i = 0; i <= 600; ++i) attitudes.push_back({2 * std::numbers::pi * share * i / 600, 0, 0});
    EllipseEstimator estimator(thesis_noise());
    Iron iron;
    iron.hard_uT = {2, 1, 0};
    feed(estimator, field_on(attitudes, iron, random));
    EXPECT_NEAR(estimator.judgement().coverage, share, 0.03);
  }
}

TEST(Ellipse, CellsAreAsGoodAsSingleReadings) {
  Random random(3);
  for (const char* path : {"path2", "path3", "path4"}) {
    EllipseEstimator estimator(thesis_noise());
    const auto readings = level_field_on(load_true_path(path), figure_4_12(), Noise{}, random);
    feed(estimator, readings);
    estimator.settle();
    EllipseCells single;
    for (const auto& r : readings) {
      FieldCells<2, 4>::Cell cell;
      cell.count = 1;
      cell.mean.head<2>() = r.field_body_uT.head<2>();
      single.push_back(cell);
    }
    EllipseFit fit = *estimator.fit();
    for (int i = 0; i < 40; ++i) fit = improve(fit, single, thesis_noise().noise_uT);
    const EllipseShape::Vector std = fit.covariance.diagonal().cwiseSqrt();
    EXPECT_LT((fit.shape.centre_uT - estimator.fit()->shape.centre_uT).cwiseQuotient(std.head<2>()).norm(), 0.1)
        << path;
  }
}

TEST(Ellipse, RestoredGoesOnBitForBit) {
  Random random(4);
  const auto readings = level_field_on(load_true_path("path6"), figure_4_11(), Noise{}, random);
  const auto saved = [](EllipseEstimator& estimator) {
    Archive archive;
    archive(estimator);
    return archive.bytes();
  };
  EllipseEstimator one(thesis_noise()), other(thesis_noise());
  feed(one, {readings.begin(), readings.begin() + 177});
  const std::string bytes = saved(one);
  Archive archive{std::string_view(bytes)};
  archive(other);
  ASSERT_TRUE(archive.ok() && archive.at_end());
  feed(one, {readings.begin() + 177, readings.end()});
  feed(other, {readings.begin() + 177, readings.end()});
  EXPECT_EQ(saved(one), saved(other));
}

TEST(Ellipse, TheConditionIsThatOfUnknownsInUnitsOfTheirErrors) {
  Eigen::Matrix<double, 5, 5> covariance = Eigen::Matrix<double, 5, 5>::Identity();
  covariance(0, 1) = covariance(1, 0) = 0.9;
  const Eigen::Vector<double, 5> units(1, 1e-3, 1e3, 1, 1);
  EXPECT_NEAR(condition_of<5>(units.asDiagonal() * covariance * units.asDiagonal()), 19, 1e-6);
  covariance(0, 1) = covariance(1, 0) = 1;
  EXPECT_GT(condition_of<5>(covariance), 1e12) << "two that are one";
  covariance(0, 0) = 0;
  EXPECT_TRUE(std::isinf(condition_of<5>(covariance)));
}

TEST(Ellipse, StatedErrorsCoverTheTruth) {
  // A binomial of 5 x 60 at 95.4 %: 99.9 % of such shares lie above 91 %. bench_calibration has the rows.
  const EllipseShape truth = figure_4_12();
  Random random(5);
  int within = 0, numbers = 0;
  for (const char* name : {"path2", "path3", "path4"}) {
    const auto path = load_true_path(name);
    for (int run = 0; run < 20; ++run) {
      EllipseEstimator estimator(thesis_noise());
      feed(estimator, level_field_on(path, truth, Noise{}, random));
      estimator.settle();
      const EllipseShape& shape = estimator.fit()->shape;
      const auto& covariance = estimator.fit()->covariance;
      const std::array off{shape.centre_uT.x() - truth.centre_uT.x(), shape.centre_uT.y() - truth.centre_uT.y(),
                           shape.axes_uT(0, 0) - truth.axes_uT(0, 0), shape.axes_uT(0, 1) - truth.axes_uT(0, 1),
                           shape.axes_uT(1, 1) - truth.axes_uT(1, 1)};
      for (int i = 0; i < 5; ++i) {
        ++numbers;
        within += std::abs(off[static_cast<std::size_t>(i)]) <= 2 * std::sqrt(covariance(i, i));
      }
    }
  }
  EXPECT_GE(within, numbers * 91 / 100);
  EXPECT_LE(within, numbers * 99 / 100);
}

}  // namespace
}  // namespace navcal::calib::test
