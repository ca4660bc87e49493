// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/model_fit.h"

namespace navcal::gap {

/// A set of effects and how probable it is beside the others that were looked at.
struct Candidate {
  EffectSubset effects;  ///< empty: no effect
  double log_odds = 0;   ///< against no effect, nats; of sets equally far, by their evidence
  double probability = 0;
};

struct SearchResult {
  std::vector<Candidate> candidates;  ///< most probable first
  ModelFit best;                      ///< of the first of them
  /// Posterior of all unknowns where the best set's are zero and the others within tolerance. Were its own within
  /// tolerance, too, strong data would make them what they are in spite of it.
  Eigen::VectorXd mean_without_effects;
  std::vector<double> expected_information_nats;  ///< of the best set
};

/// Those of the best set that this mission hardly shows, were they as strong as usual.
[[nodiscard]] EffectSubset unobservable_effects(const SearchResult& result);

/// Of each effect of a fit: what the mission would tell of it, nats, if it had the direction that was found and
/// its typical strength.
[[nodiscard]] std::vector<double> expected_information_nats(const ModelFit& fit, const InferenceProblem& problem);

/// The result of a search of no subsets but the empty one.
[[nodiscard]] SearchResult nothing_found(const InferenceProblem& problem);

}  // namespace navcal::gap
