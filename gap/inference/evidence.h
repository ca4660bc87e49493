// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <span>
#include <vector>

namespace navcal::gap {

/// Gaussian marginal likelihood of whitened innovations r = X theta + e, e ~ N(0, 1), theta ~ N(0, D): of a base,
/// in which every effect has the narrow prior of what a vehicle within tolerance shows (spike, never zero), and of
/// sets of effects whose parameters have the wide one (slab) instead. See docs/gap.md.
class Evidence {
 public:
  /// gram = X^T X, score = X^T r of data referred to theta = 0; standard deviations of the priors.
  Evidence(Eigen::MatrixXd gram, Eigen::VectorXd score, Eigen::VectorXd spike, Eigen::VectorXd slab);

  /// Log of marginal likelihood, apart from what depends on r alone, of the base.
  [[nodiscard]] double base() const { return base_; }
  /// By how much it grows when these unknowns get slabs of these standard deviations.
  [[nodiscard]] double gain(std::span<const Eigen::Index> members, const Eigen::VectorXd& slabs) const;
  /// Posterior of all unknowns.
  struct Posterior {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
  };
  [[nodiscard]] Posterior posterior(std::span<const Eigen::Index> members) const;
  [[nodiscard]] const Posterior& base_posterior() const { return posterior_; }
  /// Expected gain, nats, of these members over the base if they had their typical strength, when others may
  /// take their part: 1/2 of the squared strength that the others, at their slabs, cannot explain.
  [[nodiscard]] double separation(std::span<const Eigen::Index> members, const Eigen::VectorXd& values,
                                  std::span<const Eigen::Index> others) const;

 private:
  [[nodiscard]] Posterior solve(const Eigen::VectorXd& prior, double* log_evidence) const;

  Eigen::MatrixXd gram_;
  Eigen::VectorXd score_, spike_, slab_;
  double base_ = 0;
  Posterior posterior_;
};

/// Mean of the posterior alone, by a prior of these standard deviations: what a whole one costs is its covariance.
[[nodiscard]] Eigen::VectorXd posterior_mean(const Eigen::MatrixXd& gram, const Eigen::VectorXd& score,
                                             const Eigen::VectorXd& prior);

}  // namespace navcal::gap
