// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/search.h"

#include <algorithm>

#include "gap/inference/subset_evidence.h"
#include "gap/thresholds.h"

namespace navcal::gap {

EffectSubset unobservable_effects(const SearchResult& result) {
  EffectSubset hidden;
  for (std::size_t i = 0; i < result.best.effects.size(); ++i) {
    if (result.expected_information_nats[i] < kObservable_nats) hidden.push_back(result.best.effects[i]);
  }
  return hidden;
}

std::vector<double> expected_information_nats(const ModelFit& fit, const InferenceProblem& problem) {
  const Library& library = problem.model.library;
  const Evidence evidence = evidence_of(fit.linear, problem.priors);
  std::vector<double> nats;
  for (const std::size_t effect : fit.effects) {
    const double strength = strength_of(library, effect, fit.mean);
    const Eigen::VectorXd typical = fit.mean / std::max(strength, 1e-9);
    nats.push_back(evidence.separation(parameter_indices(library, {effect}), typical, {}));
  }
  return nats;
}

SearchResult nothing_found(const InferenceProblem& problem) {
  SearchResult result;
  result.best = fit_model({}, problem);
  result.best.log_odds = 0;
  result.mean_without_effects = bounded_posterior(problem.about(problem.nominal), {}).mean;
  result.candidates = {{{}, 0, 1}};
  return result;
}

}  // namespace navcal::gap
