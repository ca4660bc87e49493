// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/angles.h"
#include "calib/magnetometer/ellipse_estimator.h"
#include "tests/calib/magnetometer_paths.h"

namespace navcal::calib::test {
namespace {

/// `count` readings over `arc_deg` from `first_deg`, forth and back.
EllipseEstimator over_arc(const EllipseShape& truth, double first_deg, double arc_deg, int count = 600) {
  Random random(7);
  std::normal_distribution<double> noise(0, 0.15);
  EllipseEstimator estimator({});
  for (int i = 0; i < count; ++i) {
    const double there = 0.5 - 0.5 * std::cos(0.03 * i);
    Eigen::Vector3d field = Eigen::Vector3d::Zero();
    field.head<2>() = truth.at((first_deg + arc_deg * there) * base::kRadiansPerDegree);
    field.head<2>() += Eigen::Vector2d(noise(random), noise(random));
    estimator.update(field, 0, 0);
  }
  estimator.settle();
  return estimator;
}

void expect_refused(const EllipseEstimator& estimator) {
  const Judgement judgement = estimator.judgement();
  EXPECT_FALSE(judgement.accepted);
  EXPECT_FALSE(judgement.reason.empty());
  EXPECT_FALSE(judgement.manoeuvre.empty());
}

TEST(EllipseJudgement, ShortArcsAreRefusedWithWhatIsMissing) {
  for (const double arc : {5., 30., 60., 90., 120.}) expect_refused(over_arc(figure_4_11(), 20, arc));
  const Judgement judgement = over_arc(figure_4_11(), 20, 90).judgement();
  EXPECT_NE(judgement.manoeuvre.find("turn through "), std::string::npos) << judgement.manoeuvre;
  EXPECT_NE(judgement.manoeuvre.find("headings 11"), std::string::npos)
      << judgement.manoeuvre;  // 110, but for noise
}

TEST(EllipseJudgement, FullCirclesAreAccepted) {
  for (const EllipseShape& truth : {figure_4_11(), figure_4_12()}) {
    const auto estimator = over_arc(truth, 0, 400);
    EXPECT_TRUE(estimator.judgement().accepted) << estimator.judgement().reason;
    EXPECT_GT(estimator.judgement().coverage, 0.95);
  }
}

TEST(EllipseJudgement, NoTurnFrozenFieldAndStraightLineAreRefused) {
  expect_refused(over_arc(figure_4_11(), 20, 0));
  EllipseEstimator frozen({}), line({});
  for (int i = 0; i < 600; ++i) {
    frozen.update({12, 3, 44}, 0, 0);
    line.update({0.05 * i, 0.1 * i, 44}, 0, 0);
  }
  frozen.settle();
  line.settle();
  expect_refused(frozen);
  expect_refused(line);
  expect_refused(EllipseEstimator({}));
}

TEST(EllipseBadInput, AnOffsetLargerThanTheFieldIsFound) {
  EllipseShape truth = figure_4_11();
  truth.centre_uT = {70, -90};
  const auto estimator = over_arc(truth, 0, 400);
  EXPECT_LT((estimator.fit()->shape.centre_uT - truth.centre_uT).norm(), 0.1);
}

TEST(EllipseBadInput, WhatIsNoFieldChangesNothing) {
  Random random(8);
  EllipseEstimator clean({}), dirty({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& r : level_field_on(load_true_path("path2"), figure_4_11(), Noise{}, random)) {
    clean.update(r.field_body_uT, 0, 0);
    dirty.update(r.field_body_uT, 0, 0);
    dirty.update({nan, 1, 2}, 0, 0);
    dirty.update({1, 2, 3}, nan, 0);
    dirty.update({1e300, 1e300, 0}, 0, 0);
    dirty.update({std::numeric_limits<double>::infinity(), 0, 0}, 0, 0);
  }
  Archive one, other;
  one(clean);
  other(dirty);
  EXPECT_EQ(one.bytes(), other.bytes());
}

TEST(EllipseBadInput, OutliersDoNotSpoilIt) {
  Random random(9);
  std::uniform_real_distribution<double> anywhere(-60, 60);
  EllipseEstimator estimator({});
  int i = 0;
  for (const auto& r : level_field_on(load_true_path("path2"), figure_4_11(), Noise{}, random)) {
    estimator.update(r.field_body_uT, 0, 0);
    if (++i % 50 == 0) estimator.update({anywhere(random), anywhere(random), 0}, 0, 0);
  }
  estimator.settle();
  EXPECT_LT(heading_error(estimator.estimate()->correction, figure_4_11()).largest_deg, 0.3);
}

TEST(EllipseBadInput, TheSummaryIsBounded) {
  Random random(10);
  std::uniform_real_distribution<double> anywhere(-400, 400);
  EllipseEstimator estimator({});
  for (int i = 0; i < 5000; ++i) estimator.update({anywhere(random), anywhere(random), 0}, 0, 0);
  EXPECT_LE(estimator.cells().cells().size(), (FieldCells<2, 4>::kCapacity));
  expect_refused(estimator);
}

}  // namespace
}  // namespace navcal::calib::test
