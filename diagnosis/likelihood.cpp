// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/likelihood.h"

#include <Eigen/Cholesky>

namespace navcal::diagnosis {
namespace {

/// Factor of 1 + root^T information root.
Eigen::LLT<Eigen::MatrixXd> factor_of(const Eigen::MatrixXd& information, const Eigen::MatrixXd& root) {
  Eigen::MatrixXd scaled = root.transpose() * information * root;
  scaled.diagonal().array() += 1;
  return Eigen::LLT<Eigen::MatrixXd>(scaled);
}

}  // namespace

Likelihood Likelihood::about(const Eigen::VectorXd& at) const {
  const Eigen::VectorXd image = information * at;
  return {information, score - image, value + score.dot(at) - at.dot(image) / 2};
}

Likelihood Likelihood::blurred(const Eigen::MatrixXd& root) const {
  const auto factor = factor_of(information, root);
  // With F F^T the factored matrix: |F^-1 root^T (score - information x)|^2 / 2 is added.
  const Eigen::VectorXd of_score = factor.matrixL().solve(root.transpose() * score);
  const Eigen::MatrixXd of_information = factor.matrixL().solve(root.transpose() * information);
  return {information - of_information.transpose() * of_information, score - of_information.transpose() * of_score,
          value + of_score.squaredNorm() / 2 - factor.matrixLLT().diagonal().array().log().sum()};
}

Likelihood Likelihood::of(const std::vector<Eigen::Index>& columns) const {
  return {information(columns, columns), score(columns), value};
}

Likelihood& Likelihood::operator+=(const Likelihood& other) {
  information += other.information;
  score += other.score;
  value += other.value;
  return *this;
}

Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& information, const Eigen::VectorXd& stds) {
  return stds.asDiagonal() * factor_of(information, stds.asDiagonal()).solve(Eigen::MatrixXd(stds.asDiagonal()));
}

Eigen::VectorXd JointPrior::posterior_mean(const Likelihood& likelihood) const {
  const Eigen::VectorXd score = root.transpose() * (likelihood.score - likelihood.information * mean);
  return mean + root * factor_of(likelihood.information, root).solve(score);
}

}  // namespace navcal::diagnosis
