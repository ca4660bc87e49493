// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/evidence.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdint>
#include <random>

namespace navcal::gap {
namespace {

struct Problem {
  Eigen::MatrixXd design;
  Eigen::VectorXd data, spike, slab;
};

Problem problem(std::uint64_t seed) {
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  Problem p;
  p.design = Eigen::MatrixXd::NullaryExpr(40, 5, [&] { return normal(dice); });
  p.data = Eigen::VectorXd::NullaryExpr(40, [&] { return normal(dice); });
  p.spike = Eigen::VectorXd::Constant(5, 0.1);
  p.slab = Eigen::VectorXd::LinSpaced(5, 1, 3);
  return p;
}

/// Log density of N(0, 1 + X D X^T), apart from what does not depend on D.
double log_likelihood(const Problem& p, const Eigen::VectorXd& prior) {
  const Eigen::MatrixXd covariance =
      Eigen::MatrixXd::Identity(40, 40) + p.design * prior.cwiseAbs2().asDiagonal() * p.design.transpose();
  return -0.5 * p.data.dot(covariance.lu().solve(p.data)) - 0.5 * std::log(covariance.determinant()) +
         0.5 * p.data.squaredNorm();
}

Evidence evidence_of(const Problem& p) {
  return {p.design.transpose() * p.design, p.design.transpose() * p.data, p.spike, p.slab};
}

TEST(Evidence, IsTheLikelihoodOfTheDataUnderThePrior) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Problem p = problem(seed);
    const Evidence evidence = evidence_of(p);
    EXPECT_NEAR(evidence.base(), log_likelihood(p, p.spike), 1e-9);
    for (const std::vector<Eigen::Index>& members : {std::vector<Eigen::Index>{2}, {0, 4}, {1, 2, 3}, {}}) {
      for (const double strength : {0.2, 1.0, 2.0}) {
        Eigen::VectorXd prior = p.spike;
        Eigen::VectorXd slabs(static_cast<Eigen::Index>(members.size()));
        for (Eigen::Index i = 0; i < slabs.size(); ++i) {
          const Eigen::Index j = members[static_cast<std::size_t>(i)];
          prior[j] = slabs[i] = strength * p.slab[j];
        }
        EXPECT_NEAR(evidence.base() + evidence.gain(members, slabs), log_likelihood(p, prior), 1e-9);
      }
    }
  }
}

TEST(Evidence, ThePosteriorOfAWidePriorIsLeastSquares) {
  Problem p = problem(7);
  p.spike.setConstant(1e4);
  const auto posterior = evidence_of(p).posterior({});
  const Eigen::MatrixXd gram = p.design.transpose() * p.design;
  EXPECT_LT((posterior.mean - gram.llt().solve(p.design.transpose() * p.data)).norm(), 1e-6);
  EXPECT_LT((posterior.covariance - gram.inverse()).norm(), 1e-6);
}

TEST(Evidence, TwinsTakeAllOfEachOthersSeparation) {
  Problem p = problem(8);
  p.design.col(1) = p.design.col(0);
  p.slab.setConstant(100);
  const Evidence evidence = evidence_of(p);
  const Eigen::VectorXd values = Eigen::VectorXd::Ones(5);
  const std::vector<Eigen::Index> one{0}, twin{1}, other{2};
  EXPECT_GT(evidence.separation(one, values, {}), 5);
  EXPECT_LT(evidence.separation(one, values, twin), 0.01);
  EXPECT_GT(evidence.separation(one, values, other), 5);
}

}  // namespace
}  // namespace navcal::gap
