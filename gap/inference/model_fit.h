// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/effect_subset.h"
#include "gap/inference/evidence.h"
#include "gap/inference/problem.h"

namespace navcal::gap {

/// A set of effects whose replay was taken anew where it says the vehicle is.
struct ModelFit {
  EffectSubset effects;
  double log_odds = 0;
  /// By how much less is left at the estimate, in nats, than the straight lines of its signatures say; log_odds
  /// holds it.
  double beyond_linear = 0;
  Eigen::VectorXd about;  ///< members and biases where the signatures were taken; all others at zero
  Linearised linear;      ///< with these signatures, its residual that of the whole estimate
  /// Posterior of all unknowns; the standard deviations hold what the model is known to be wrong by, and grow with
  /// noise that is more than nominal.
  Eigen::VectorXd mean, std;
};

/// The set, simulated and linearised about its own estimate, from where `start` was taken.
[[nodiscard]] ModelFit fit_model(const EffectSubset& set, const InferenceProblem& problem, Linearised start);
/// The same from the nominal vehicle.
[[nodiscard]] ModelFit fit_model(const EffectSubset& set, const InferenceProblem& problem);

/// By how much the evidence of a set is too good, nats: it goes to where straight lines are lowest, be that
/// possible or not.
[[nodiscard]] double bound_penalty_nats(const EffectSubset& set, const LinearGaussianModel& model);

/// What a linearisation about a set's own estimate says of it, with the estimate itself, tolerances included,
/// simulated until it stays.
[[nodiscard]] ModelFit refine(const EffectSubset& set, Linearised linear, const InferenceProblem& problem);

/// Of all unknowns; those that cannot be negative, lags above all, and would be stay at zero, and the others are
/// as they are then: what is answered must be a vehicle that can be simulated.
[[nodiscard]] Evidence::Posterior bounded_posterior(const LinearGaussianModel& model,
                                                    const std::vector<Eigen::Index>& members);

/// Priors by which these effects may be there unnamed, as strong as they like.
[[nodiscard]] Priors as_nuisance_parameters(Priors priors, const Library& library, const EffectSubset& effects);

/// Priors by which none of these effects is there at all.
[[nodiscard]] Priors without_members(Priors priors, const Library& library, const EffectSubset& effects);

}  // namespace navcal::gap
