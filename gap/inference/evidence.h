// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <span>

namespace navcal::gap {

/// Gaussian marginal likelihood of whitened innovations r = X theta + e, e ~ N(0, 1), theta ~ N(0, D).
///
/// In the base model every effect has the narrow prior of a vehicle within tolerance (spike, never zero). A
/// subset of effects gives its parameters the wide prior (slab) instead. See docs/gap.md.
class Evidence {
 public:
  /// gram = X^T X and score = X^T r, with r referred to theta = 0; spike and slab are standard deviations of
  /// the priors.
  Evidence(Eigen::MatrixXd gram, Eigen::VectorXd score, Eigen::VectorXd spike, Eigen::VectorXd slab);

  /// Log marginal likelihood of the base model, without the terms that depend on r alone.
  [[nodiscard]] double base() const { return base_; }
  /// Gain in log marginal likelihood when these unknowns get slabs of these standard deviations.
  [[nodiscard]] double gain(std::span<const Eigen::Index> members, const Eigen::VectorXd& slabs) const;
  /// Posterior of all unknowns.
  struct Posterior {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
  };
  [[nodiscard]] Posterior posterior(std::span<const Eigen::Index> members) const;
  [[nodiscard]] const Posterior& base_posterior() const { return posterior_; }
  /// Expected gain, nats, of these members over the base at these values, when `others` may explain part of
  /// them. It is half the squared signal that the others, at their slabs, cannot explain.
  [[nodiscard]] double separation(std::span<const Eigen::Index> members, const Eigen::VectorXd& values,
                                  std::span<const Eigen::Index> others) const;

 private:
  [[nodiscard]] Posterior solve(const Eigen::VectorXd& prior, double* log_evidence) const;

  Eigen::MatrixXd gram_;
  Eigen::VectorXd score_, spike_, slab_;
  double base_ = 0;
  Posterior posterior_;
};

/// Posterior mean under a prior of these standard deviations. It skips the covariance, which is the costly part
/// of a posterior.
[[nodiscard]] Eigen::VectorXd posterior_mean(const Eigen::MatrixXd& gram, const Eigen::VectorXd& score,
                                             const Eigen::VectorXd& prior);

}  // namespace navcal::gap
