// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/effect_subset.h"
#include "gap/verdict/find_effects.h"

namespace navcal::gap {

/// A set of effects that could be true.
struct Hypothesis {
  EffectSubset effects;    ///< empty: no effect
  double log_odds = 0;     ///< by the recordings, against no effect, nats
  double probability = 0;  ///< among the hypotheses
  Eigen::VectorXd values;  ///< of all unknowns if it is true: its members' estimate
};

/// The sets that the recordings leave probable, most probable first; no effect is always one of them.
[[nodiscard]] std::vector<Hypothesis> probable_hypotheses(const DiagnosisProblem& problem,
                                                          const FoundEffects& found);

/// No effect, and each effect of the library alone at `strength` typical values: what a mission is tested for that
/// shows no gap. Parameters of one effect have equal shares.
[[nodiscard]] std::vector<Hypothesis> weak_hypotheses(const Library& library, const Priors& priors,
                                                      double strength);

/// Information about all unknowns, Jacobian^T Jacobian, with the gyros' biases integrated out (their rows are
/// zero).
[[nodiscard]] Eigen::MatrixXd information_without_biases(const Eigen::MatrixXd& gram, const Priors& priors);

/// What a model (the members of a hypothesis at their slabs, all others within tolerance) makes of data with this
/// information: what separations between models are computed from.
class ModelForecast {
 public:
  ModelForecast(const EffectSubset& members, const Eigen::MatrixXd& information, const Library& library,
                const Priors& priors);

  /// Half the squared signal of these values that the model cannot take over, nats.
  [[nodiscard]] double unexplained_nats(const Eigen::VectorXd& values) const;
  /// Expected log evidence over `other` if these values are true in this model, nats: the signal that the other
  /// model cannot take over, and the difference of both models' Occam factors (MacKay 2003, chapter 28).
  [[nodiscard]] double expected_over(const ModelForecast& other, const Eigen::VectorXd& values) const;

 private:
  Eigen::MatrixXd left_;  ///< G - G M G, with the posterior covariance M of the model
  double log_determinant_ = 0, trace_ = 0;
};

/// Probability that the true set is named exactly, averaged over the hypotheses: for each, its log odds against
/// every other one become normal deviates with mean (log odds so far + separation) and variance 2 separation, and
/// the least favourable one decides. `separation(a, b)`: of hypothesis a against b if a is true.
[[nodiscard]] double probability_of_exact_answer(const std::vector<Hypothesis>& hypotheses,
                                                 const Eigen::MatrixXd& separation);

}  // namespace navcal::gap
