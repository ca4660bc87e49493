// SPDX-License-Identifier: Apache-2.0
#include "gap/design/hypothesis.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "tests/gap/design/observed_separation.h"

namespace navcal::gap::test {
namespace {

/// Gram matrix of a random design of so many rows.
Eigen::MatrixXd random_gram(Eigen::Index unknowns, Eigen::Index rows, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd design =
      Eigen::MatrixXd::NullaryExpr(rows, unknowns, [&](Eigen::Index, Eigen::Index) { return normal(generator); });
  return design.transpose() * design;
}

Hypothesis hypothesis(const Eigen::VectorXd& mean, double spread, double probability) {
  return {{}, probability, mean, spread * Eigen::MatrixXd::Identity(mean.size(), mean.size())};
}

constexpr Eigen::Index kUnknowns = 6;

TEST(Hypothesis, EqualOnesAreNotSeparated) {
  const auto a = hypothesis(Eigen::VectorXd::Ones(kUnknowns), 0.3, 0.5);
  EXPECT_NEAR(expected_separation_nats(a, a, random_gram(kUnknowns, 50, 1)), 0, 1e-9);
}

TEST(Hypothesis, SeparationIsHalfTheSquaredSignalWhereNothingIsUncertain) {
  const auto a = hypothesis(Eigen::VectorXd::Unit(kUnknowns, 0), 1e-9, 0.5);
  const auto b = hypothesis(Eigen::VectorXd::Zero(kUnknowns), 1e-9, 0.5);
  const Eigen::MatrixXd gram = random_gram(kUnknowns, 50, 2);
  EXPECT_NEAR(expected_separation_nats(a, b, gram), gram(0, 0) / 2, 1e-6 * gram(0, 0));
}

TEST(Hypothesis, MoreDataNeverSeparateLess) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  const auto a = hypothesis(Eigen::VectorXd::LinSpaced(kUnknowns, -1, 1), 0.4, 0.5);
  const auto b = hypothesis(Eigen::VectorXd::LinSpaced(kUnknowns, 0.5, -0.3), 0.7, 0.5);
  double before = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    gram += random_gram(kUnknowns, 3, seed);
    const double nats = expected_separation_nats(a, b, gram);
    EXPECT_GE(nats, before);
    before = nats;
  }
}

TEST(Hypothesis, ObservedSeparationHasTheExpectedMean) {
  const Eigen::MatrixXd gram = random_gram(kUnknowns, 30, 4);
  const Eigen::MatrixXd root = gram.llt().matrixL();
  const auto a = hypothesis(Eigen::VectorXd::LinSpaced(kUnknowns, -0.4, 0.4), 0.3, 0.5);
  const auto b = hypothesis(Eigen::VectorXd::Zero(kUnknowns), 0.2, 0.5);
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const auto draw = [&] {
    return Eigen::VectorXd(
        Eigen::VectorXd::NullaryExpr(kUnknowns, [&](Eigen::Index) { return normal(generator); }));
  };
  double sum = 0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::VectorXd theta = a.mean + a.spread * draw();
    sum += observed_separation_nats(a, b, gram, gram * theta + root * draw());
  }
  const double expected = expected_separation_nats(a, b, gram);
  EXPECT_NEAR(sum / kDraws, expected, 0.05 * expected);
}

TEST(Hypothesis, ProbabilityAndBoundFollowTheSeparation) {
  const Eigen::MatrixXd gram = random_gram(kUnknowns, 30, 6);
  const std::vector<Hypothesis> sets{hypothesis(Eigen::VectorXd::Unit(kUnknowns, 0), 0.05, 0.6),
                                     hypothesis(Eigen::VectorXd::Unit(kUnknowns, 1), 0.05, 0.4)};
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  EXPECT_EQ(probability_exact(sets, none, 0.85), 0);
  EXPECT_GT(probability_exact(sets, gram, 0.85), 0.95);
  EXPECT_NEAR(log_error_bound(sets, none), 0.5 * std::log(0.24), 1e-9);
  EXPECT_LT(log_error_bound(sets, gram), -3);
  const std::vector<Hypothesis> one(sets.begin(), sets.begin() + 1);
  EXPECT_EQ(probability_exact(one, none, 0.85), 1);
}

}  // namespace
}  // namespace navcal::gap::test
