// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace navcal::diagnosis {

/// A log likelihood that is quadratic in some unknowns x:
///   log p = value + score . x - x . information x / 2.
struct Likelihood {
  Eigen::MatrixXd information;
  Eigen::VectorXd score;
  double value = 0;

  /// The same as a function of x - at.
  [[nodiscard]] Likelihood about(const Eigen::VectorXd& at) const;
  /// Of the same x when a deviate root z, z ~ N(0, 1), is added to it and integrated out.
  [[nodiscard]] Likelihood blurred(const Eigen::MatrixXd& root) const;
  /// Of some of the unknowns, the others zero.
  [[nodiscard]] Likelihood of(const std::vector<Eigen::Index>& columns) const;
  Likelihood& operator+=(const Likelihood& other);
};

/// Covariance of normal unknowns with these standard deviations, behind readings with this information.
[[nodiscard]] Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& information, const Eigen::VectorXd& stds);

/// x ~ N(mean, root root^T).
struct JointPrior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd root;

  /// Likelihood of changes a of x, x itself integrated out.
  [[nodiscard]] Likelihood of_changes(const Likelihood& likelihood) const {
    return likelihood.about(mean).blurred(root);
  }
  [[nodiscard]] Eigen::VectorXd posterior_mean(const Likelihood& likelihood) const;
};

}  // namespace navcal::diagnosis
