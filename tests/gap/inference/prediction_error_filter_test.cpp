// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "gap/inference/whitening.h"

namespace navcal::gap {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Two channels of white noise about one that neither says alone and that wanders for twenty intervals; a third
/// has nothing to do with them.
Eigen::MatrixXd wandering(std::uint64_t seed, Eigen::Index rows = 4000) {
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd made(rows, 3);
  double common = 0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    common = 0.95 * common + 0.3 * normal(dice);
    made.row(i) << common + normal(dice), 1e-3 * (common + normal(dice)), 50 * normal(dice);
  }
  return made;
}

PredictionErrorFilter learnt() {
  const std::vector<Eigen::MatrixXd> noise{wandering(1), wandering(2), wandering(3), wandering(4)};
  return PredictionErrorFilter::learnt(noise, 100);
}

double mean_square(const Eigen::MatrixXd& rows, Eigen::Index column) {
  const auto settled = rows.col(column).tail(rows.rows() - 100);
  return settled.squaredNorm() / static_cast<double>(settled.size());
}

TEST(PredictionErrorFilter, LeavesWhatTheBestPredictionLeaves) {
  const Eigen::MatrixXd errors = learnt().errors(wandering(5, 40000));
  // Kalman filter with both channels: its variance p of the common one solves the Riccati equation.
  double p = 1;
  for (int i = 0; i < 1000; ++i) p = 0.95 * 0.95 * (p - p * p * 2 / (2 * p + 1)) + 0.09;
  EXPECT_NEAR(mean_square(errors, 0), 1 + p, 0.03 * (1 + p));
  EXPECT_NEAR(mean_square(errors, 1), 1e-6 * (1 + p), 0.03e-6 * (1 + p));
  EXPECT_NEAR(mean_square(errors, 2), 2500, 75);
}

TEST(PredictionErrorFilter, LeavesWhatIsWhite) {
  const Eigen::MatrixXd errors = learnt().errors(wandering(6, 40000));
  for (Eigen::Index a = 0; a < 2; ++a) {
    for (Eigen::Index b = 0; b < 2; ++b) {
      for (const Eigen::Index lag : {1, 2, 3, 7, 20, 60}) {
        const double product = errors.col(a).tail(39000).dot(errors.col(b).segment(1000 - lag, 39000)) / 39000;
        EXPECT_LT(std::abs(product) / std::sqrt(mean_square(errors, a) * mean_square(errors, b)), 0.05)
            << a << ' ' << b << ' ' << lag;
      }
    }
  }
}

TEST(PredictionErrorFilter, PredictsNothingUnlessToldHow) {
  const Eigen::MatrixXd rows = wandering(7, 200);
  EXPECT_EQ(PredictionErrorFilter().errors(rows), rows);
  EXPECT_EQ(PredictionErrorFilter::learnt({}, 0).errors(rows), rows);
  const std::vector<Eigen::MatrixXd> few{wandering(8, 150)};
  EXPECT_EQ(PredictionErrorFilter::learnt(few, 0).errors(rows), rows) << "fewer rows than tell so many weights";
}

TEST(PredictionErrorFilter, WhatWasNotMeasuredLeavesNothingAndIsAsPredicted) {
  const PredictionErrorFilter filter = learnt();
  Eigen::MatrixXd rows = wandering(9, 500), lacking = rows;
  lacking.block(300, 0, 40, 2).setConstant(kNothing);
  const Eigen::MatrixXd errors = filter.errors(lacking);
  EXPECT_EQ(errors.block(300, 0, 40, 2).cwiseAbs().sum(), 0);
  EXPECT_TRUE(errors.allFinite());
  EXPECT_EQ(errors.topRows(300), filter.errors(rows).topRows(300)) << "nothing knows what is to come";
  Eigen::MatrixXd as_predicted = rows;
  for (Eigen::Index i = 300; i < 340; ++i) {
    for (Eigen::Index j = 0; j < 2; ++j) as_predicted(i, j) -= filter.errors(as_predicted)(i, j);
  }
  EXPECT_LT((filter.errors(as_predicted) - errors).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PredictionErrorFilter, LearnsFromChannelsThatAreMeasuredNowAndThenOrNever) {
  std::vector<Eigen::MatrixXd> noise;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    noise.push_back(wandering(seed));
    for (Eigen::Index i = 0; i < noise.back().rows(); i += 2) noise.back()(i, 1) = kNothing;
    noise.back().col(2).setConstant(kNothing);
  }
  const PredictionErrorFilter filter = PredictionErrorFilter::learnt(noise, 100);
  ASSERT_TRUE(filter.weights().allFinite());
  EXPECT_EQ(filter.weights().col(2).cwiseAbs().sum(), 0);
  Eigen::MatrixXd rows = wandering(10, 20000);
  const double all = mean_square(rows, 0);
  for (Eigen::Index i = 0; i < rows.rows(); i += 2) rows(i, 1) = kNothing;
  rows.col(2).setConstant(kNothing);
  EXPECT_LT(mean_square(filter.errors(rows), 0), 0.8 * all);
}

}  // namespace
}  // namespace navcal::gap
