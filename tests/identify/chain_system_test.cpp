// SPDX-License-Identifier: Apache-2.0
#include "identify/fit/chain_system.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace navcal::identify {
namespace {

constexpr Eigen::Index kParameters = 3;
constexpr std::size_t kWindows = 4;

/// A chain of random equations and the same as one dense matrix.
struct ChainExample {
  ChainSystem system{kParameters, {kWindows}};
  std::vector<WindowEquations> windows;
  Eigen::MatrixXd gram;
  Eigen::VectorXd score;

  ChainExample() {
    const Eigen::Index border = kParameters + kNuisances;
    const Eigen::Index size = border + static_cast<Eigen::Index>(kWindows) * kStates;
    gram = Eigen::MatrixXd::Zero(size, size);
    score = Eigen::VectorXd::Zero(size);
    for (std::size_t k = 0; k < kWindows; ++k) {
      Eigen::MatrixXd jacobian = Eigen::MatrixXd::Random(90, border + 2 * kStates);
      const bool is_last = k + 1 == kWindows;
      if (is_last) jacobian.rightCols<kStates>().setZero();
      windows.push_back({jacobian.transpose() * jacobian, jacobian.transpose() * Eigen::VectorXd::Random(90)});
      system.add(0, k, windows.back());
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(90, size);
      all.leftCols(border) = jacobian.leftCols(border);
      const Eigen::Index at = border + static_cast<Eigen::Index>(k) * kStates;
      all.middleCols(at, kStates) = jacobian.middleCols(border, kStates);
      if (!is_last) all.middleCols(at + kStates, kStates) = jacobian.rightCols<kStates>();
      gram += all.transpose() * all;
      score.head(border) += windows.back().score.head(border);
      score.segment(at, kStates) += windows.back().score.segment(border, kStates);
      if (!is_last) score.segment(at + kStates, kStates) += windows.back().score.tail<kStates>();
    }
  }
};

TEST(ChainSystem, SolvesAsOneMatrixDoes) {
  const ChainExample example;
  const Eigen::VectorXd wanted = Eigen::LDLT<Eigen::MatrixXd>(example.gram).solve(example.score);
  const auto solution = example.system.solve(0);
  const Eigen::Index border = example.system.border();
  EXPECT_LT((solution.border - wanted.head(border)).norm(), 1e-8 * wanted.norm());
  for (std::size_t k = 0; k < kWindows; ++k) {
    const Eigen::Index at = border + static_cast<Eigen::Index>(k) * kStates;
    EXPECT_LT((solution.states[0][k] - wanted.segment(at, kStates)).norm(), 1e-8 * wanted.norm());
  }
}

TEST(ChainSystem, InformationIsTheInverseOfTheBordersCovariance) {
  const ChainExample example;
  const Eigen::Index border = example.system.border();
  const Eigen::MatrixXd covariance =
      Eigen::LDLT<Eigen::MatrixXd>(example.gram)
          .solve(Eigen::MatrixXd::Identity(example.gram.rows(), example.gram.cols()));
  const Eigen::MatrixXd product = example.system.information() * covariance.topLeftCorner(border, border);
  EXPECT_LT((product - Eigen::MatrixXd::Identity(border, border)).norm(), 1e-6);
}

TEST(ChainSystem, EffectiveScoresAddUpToThatOfTheBorder) {
  const ChainExample example;
  const Eigen::VectorXd sum = example.system.effective_scores(0, example.windows).rowwise().sum();
  const Eigen::VectorXd border = example.system.solve(0).border;
  EXPECT_LT((example.system.information() * border - sum).norm(), 1e-8 * sum.norm());
}

}  // namespace
}  // namespace navcal::identify
