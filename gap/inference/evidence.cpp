// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/evidence.h"

#include <Eigen/LU>
#include <cmath>

namespace navcal::gap {
namespace {

/// Factor of A = D^1/2 G D^1/2 + 1, scaled by the prior so that it is well conditioned.
Eigen::LLT<Eigen::MatrixXd> scaled_factor(const Eigen::MatrixXd& gram, const Eigen::VectorXd& prior) {
  Eigen::MatrixXd scaled = prior.asDiagonal() * gram * prior.asDiagonal();
  scaled.diagonal().array() += 1;
  return Eigen::LLT<Eigen::MatrixXd>(scaled);
}

}  // namespace

Eigen::VectorXd posterior_mean(const Eigen::MatrixXd& gram, const Eigen::VectorXd& score,
                               const Eigen::VectorXd& prior) {
  const Eigen::VectorXd half = prior.cwiseProduct(score);
  return prior.cwiseProduct(scaled_factor(gram, prior).solve(half));
}

Evidence::Evidence(Eigen::MatrixXd gram, Eigen::VectorXd score, Eigen::VectorXd spike, Eigen::VectorXd slab)
    : gram_(std::move(gram)), score_(std::move(score)), spike_(std::move(spike)), slab_(std::move(slab)) {
  posterior_ = solve(spike_, &base_);
}

Evidence::Posterior Evidence::solve(const Eigen::VectorXd& prior, double* log_evidence) const {
  const auto factor = scaled_factor(gram_, prior);
  const Eigen::VectorXd half = prior.cwiseProduct(score_);
  const Eigen::VectorXd solved = factor.solve(half);
  if (log_evidence != nullptr) {
    *log_evidence = 0.5 * half.dot(solved) - factor.matrixLLT().diagonal().array().log().sum();
  }
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(prior.size(), prior.size()));
  return {prior.cwiseProduct(solved), prior.asDiagonal() * inverse * prior.asDiagonal()};
}

double Evidence::gain(std::span<const Eigen::Index> members, const Eigen::VectorXd& slabs) const {
  // p(r | slab) / p(r | spike) = E[ N(theta; 0, slab) / N(theta; 0, spike) ] over the members' posterior in the
  // base model. With mean m and covariance V of that posterior, and more = slab^-2 - spike^-2 (negative), it is
  //   (prod spike / slab) |1 + V more|^-1/2 exp(-1/2 m^T more (1 + V more)^-1 m).
  const auto n = static_cast<Eigen::Index>(members.size());
  Eigen::VectorXd mean(n), more(n);
  Eigen::MatrixXd covariance(n, n);
  double log_ratio = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index a = members[static_cast<std::size_t>(i)];
    mean[i] = posterior_.mean[a];
    more[i] = 1 / (slabs[i] * slabs[i]) - 1 / (spike_[a] * spike_[a]);
    log_ratio += std::log(spike_[a] / slabs[i]);
    for (Eigen::Index j = 0; j < n; ++j) {
      covariance(i, j) = posterior_.covariance(a, members[static_cast<std::size_t>(j)]);
    }
  }
  Eigen::MatrixXd changed = covariance * more.asDiagonal();
  changed.diagonal().array() += 1;
  const Eigen::PartialPivLU<Eigen::MatrixXd> factor(changed);
  const double quadratic = (more.asDiagonal() * mean).dot(factor.solve(mean));
  return log_ratio - 0.5 * std::log(std::abs(factor.determinant())) - 0.5 * quadratic;
}

Evidence::Posterior Evidence::posterior(std::span<const Eigen::Index> members) const {
  Eigen::VectorXd prior = spike_;
  for (const Eigen::Index j : members) prior[j] = slab_[j];
  return solve(prior, nullptr);
}

double Evidence::separation(std::span<const Eigen::Index> members, const Eigen::VectorXd& values,
                            std::span<const Eigen::Index> others) const {
  Eigen::VectorXd signal = Eigen::VectorXd::Zero(gram_.cols());
  for (const Eigen::Index j : members) signal[j] = values[j];
  Eigen::VectorXd prior = spike_;
  for (const Eigen::Index j : others) prior[j] = slab_[j];
  // 1/2 s^T X^T (1 + X D X^T)^-1 X s
  const Eigen::VectorXd image = gram_ * signal;
  const Eigen::VectorXd half = prior.cwiseProduct(image);
  return 0.5 * (signal.dot(image) - half.dot(scaled_factor(gram_, prior).solve(half)));
}

}  // namespace navcal::gap
