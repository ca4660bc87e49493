// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/effect_subset.h"
#include "gap/inference/evidence.h"
#include "gap/inference/problem.h"

namespace navcal::gap {

/// A subset of effects, linearised again about its own estimate.
struct ModelFit {
  EffectSubset effects;
  double log_odds = 0;
  /// Fit of the simulated estimate minus the fit that the linear model predicts, nats. log_odds includes it.
  double beyond_linear = 0;
  Eigen::VectorXd about;  ///< point of linearisation: members and biases; all others at zero
  Linearised linear;      ///< with these regressors; its residual is that of the whole estimate
  /// Posterior of all unknowns. The standard deviations include the known errors of the model, and grow with
  /// noise above nominal.
  Eigen::VectorXd mean, std;
};

/// Fits a subset: simulates and linearises about its own estimate, beginning with the linearisation `start`.
[[nodiscard]] ModelFit fit_model(const EffectSubset& set, const InferenceProblem& problem, Linearised start);
/// The same, beginning with the linearisation about the nominal vehicle.
[[nodiscard]] ModelFit fit_model(const EffectSubset& set, const InferenceProblem& problem);

/// Amount by which the linear model's evidence of a subset is too large, nats. That evidence refers to the
/// unbounded optimum, which the bounds of the parameters may forbid.
[[nodiscard]] double bound_penalty_nats(const EffectSubset& set, const LinearGaussianModel& model);

/// Fits a subset with the regressors of `linear`. The whole estimate, tolerances included, is simulated until
/// it no longer changes.
[[nodiscard]] ModelFit refine(const EffectSubset& set, Linearised linear, const InferenceProblem& problem);

/// Posterior of all unknowns within their bounds. A parameter that cannot be negative (a lag above all) and
/// would be is held at zero; the others are estimated under that condition. The answer must be a vehicle that
/// can be simulated.
[[nodiscard]] Evidence::Posterior bounded_posterior(const LinearGaussianModel& model,
                                                    const std::vector<Eigen::Index>& members);

/// Priors that make the parameters of these effects nuisance parameters, of any strength.
[[nodiscard]] Priors as_nuisance_parameters(Priors priors, const Library& library, const EffectSubset& effects);

/// Priors that hold the parameters of these effects at zero.
[[nodiscard]] Priors without_members(Priors priors, const Library& library, const EffectSubset& effects);

}  // namespace navcal::gap
