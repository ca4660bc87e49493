// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/model_fit.h"

namespace navcal::gap {

/// A subset of effects, and its probability among the subsets that were scored.
struct Candidate {
  EffectSubset effects;  ///< empty: no effect
  double log_odds = 0;   ///< score minus that of no effect, nats (ScoreTable)
  double probability = 0;
};

struct SearchResult {
  std::vector<Candidate> candidates;  ///< most probable first
  ModelFit best;                      ///< of the first of them
  /// Posterior mean of all unknowns with the best subset's parameters at zero and the others within tolerance.
  /// If the prior of the best subset's parameters were a tolerance, strong data would overrule it.
  Eigen::VectorXd mean_without_effects;
  std::vector<double> expected_information_nats;  ///< of the best set
};

/// Effects of the best subset with too little expected information in this mission at their typical strength
/// (kObservable_nats).
[[nodiscard]] EffectSubset unobservable_effects(const SearchResult& result);

/// Expected information about each effect of a fit, nats, at its typical strength in the direction that was
/// found.
[[nodiscard]] std::vector<double> expected_information_nats(const ModelFit& fit, const InferenceProblem& problem);

/// Result of a search over the empty subset only.
[[nodiscard]] SearchResult nothing_found(const InferenceProblem& problem);

}  // namespace navcal::gap
