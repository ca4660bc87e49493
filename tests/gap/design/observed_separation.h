// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>

#include "gap/design/hypothesis.h"

namespace navcal::gap::test {

/// Log density of whitened residuals r ~ N(X m, 1 + X V X^T), by G = X^T X and s = X^T r, but for a constant that
/// all hypotheses share; V = L L^T.
inline double log_density(const Hypothesis& of, const Eigen::MatrixXd& gram, const Eigen::VectorXd& score) {
  const Eigen::MatrixXd& root = of.spread;
  const Eigen::MatrixXd inner =
      Eigen::MatrixXd::Identity(root.cols(), root.cols()) + root.transpose() * gram * root;
  const Eigen::VectorXd left = root.transpose() * (score - gram * of.mean);
  const Eigen::LLT<Eigen::MatrixXd> factor(inner);
  return of.mean.dot(score) - of.mean.dot(gram * of.mean) / 2 + left.dot(factor.solve(left)) / 2 -
         factor.matrixLLT().diagonal().array().log().sum();
}

/// Log Bayes factor, nats, for one hypothesis over another by a recording: its expectation is
/// expected_separation_nats(). `score` is referred to theta = 0.
inline double observed_separation_nats(const Hypothesis& one, const Hypothesis& other, const Eigen::MatrixXd& gram,
                                       const Eigen::VectorXd& score) {
  return log_density(one, gram, score) - log_density(other, gram, score);
}

}  // namespace navcal::gap::test
