// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/effect_subset.h"
#include "gap/verdict/find_effects.h"

namespace navcal::gap {

/// A set of effects that could be true.
struct Hypothesis {
  EffectSubset effects;     ///< empty: no effect
  double log_odds = 0;      ///< by the recordings, against no effect, nats
  double probability = 0;   ///< among the hypotheses
  Eigen::VectorXd values;   ///< of all unknowns if it is true: its members' estimate
};

/// The sets that the recordings leave probable, most probable first; no effect is always one of them.
[[nodiscard]] std::vector<Hypothesis> probable_hypotheses(const DiagnosisProblem& problem, const FoundEffects& found);

/// No effect, and each effect of the library alone at `strength` typical values: what a mission is tested for that shows
/// no gap. Parameters of one effect have equal shares.
[[nodiscard]] std::vector<Hypothesis> weak_hypotheses(const Library& library, const Priors& priors, double strength);

/// Information about all unknowns, Jacobian^T Jacobian, with the gyros' biases integrated out (their rows are zero).
[[nodiscard]] Eigen::MatrixXd information_without_biases(const Eigen::MatrixXd& gram, const Priors& priors);

/// Expected log evidence for `a` over `b`, nats, if `a` is true: half the squared signal of a's members that b's members
/// and the tolerances cannot take over, under this information.
[[nodiscard]] double expected_separation(const Hypothesis& a, const Hypothesis& b, const Eigen::MatrixXd& information,
                                         const Library& library, const Priors& priors);

/// Probability that the true set is named exactly, averaged over the hypotheses: for each, its log odds against every
/// other one become normal deviates with mean (log odds so far + separation) and variance 2 separation, and the least
/// favourable one decides. `separation(a, b)`: of hypothesis a against b if a is true.
[[nodiscard]] double probability_of_exact_answer(const std::vector<Hypothesis>& hypotheses,
                                                 const Eigen::MatrixXd& separation);

}  // namespace navcal::gap
