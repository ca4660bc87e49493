// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "diagnosis/causes.h"
#include "diagnosis/recording_fit.h"

namespace navcal::diagnosis {

/// Causes that act together: indices into CauseLibrary::causes, in order.
using CauseSet = std::vector<std::size_t>;

/// Two causes that move the same thing in the same way: the arm between the centres, the force of one actuator.
[[nodiscard]] bool are_one(const Cause& a, const Cause& b);

/// A change near which another one is looked for: the prior's mean is moved there by a share of the way.
struct Anchor {
  Eigen::VectorXd change = {};
  double share = 0;
};

/// Log evidence of sets of causes by the likelihood of changes of the nominal vehicle, nats: a mixture of the
/// strengths kMemberStrengths (docs/gap.md, "Vehicles with a layout").
class SetEvidence {
 public:
  /// The library must outlive it.
  SetEvidence(Likelihood changes, const CauseLibrary& library) : changes_(std::move(changes)), library_(library) {}

  /// Up to a constant that all sets and all linearisations of a recording share.
  [[nodiscard]] double operator()(const CauseSet& set) const { return changes_.evidence() + gain(set); }
  /// Over that of no cause.
  [[nodiscard]] double gain(const CauseSet& set) const;

  /// Estimate of the set's columns, in their order, with the widest prior.
  struct Posterior {
    std::vector<Eigen::Index> columns;
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;

    [[nodiscard]] double std(Eigen::Index i) const { return std::sqrt(covariance(i, i)); }
    /// All columns, those of no member zero.
    [[nodiscard]] Eigen::VectorXd among(Eigen::Index count) const;
  };
  [[nodiscard]] Posterior posterior(const CauseSet& set, const Anchor& anchor = {}) const;

 private:
  [[nodiscard]] double gain(const CauseSet& set, double strength) const;

  Likelihood changes_;
  const CauseLibrary& library_;
};

/// Log probability of a change by a set of causes before the recording, but for a constant.
[[nodiscard]] double log_prior_of(const Eigen::VectorXd& change, const CauseSet& set, const CauseLibrary& library);

}  // namespace navcal::diagnosis
