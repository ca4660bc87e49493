// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "gap/inference/effect_subset.h"
#include "gap/inference/library.h"
#include "gap/inference/spike_and_slab.h"

namespace navcal::gap {

/// Information of the recordings so far about all unknowns: r = X theta + e, summed over recordings.
struct Information {
  Eigen::MatrixXd gram;   ///< X^T X
  Eigen::VectorXd score;  ///< X^T r, with r referred to theta = 0
};

/// A set of effects that may be the cause, with what the recordings so far say of all unknowns if it is.
/// theta ~ N(mean, spread spread^T). The biases of the gyros are new at each power-on: they keep their prior.
struct Hypothesis {
  EffectSubset effects;
  double probability = 0;
  Eigen::VectorXd mean;
  Eigen::MatrixXd spread;
};

/// Posterior of the unknowns under a set. The scatter that a longer mission does not reduce (Priors::model_error)
/// is added to its variances.
[[nodiscard]] Hypothesis make_hypothesis(const EffectSubset& effects, double probability,
                                         const Information& so_far, const Library& library, const Priors& priors);

/// Lower triangular root of a covariance, scaled to ones on its diagonal before, because units differ by orders of
/// magnitude.
[[nodiscard]] Eigen::MatrixXd root_of(const Eigen::MatrixXd& covariance);

/// Expected log Bayes factor, nats, for `truth` over `rival` from a mission with this Gram matrix of its design,
/// if `truth` holds: the Kullback-Leibler divergence of the two predictive distributions of whitened residuals,
///   N(X m, 1 + X V X^T)  with mean m and covariance V of each hypothesis
/// (Chaloner and Verdinelli 1995, expected information). Never negative.
[[nodiscard]] double expected_separation_nats(const Hypothesis& truth, const Hypothesis& rival,
                                              const Eigen::MatrixXd& gram);

/// Upper bound of the probability that the most probable hypothesis is not the true one after the mission: the sum
/// of sqrt(p_a p_b) exp(-B_ab) over all pairs (Bhattacharyya; here B = smaller divergence / 4), its logarithm.
[[nodiscard]] double log_error_bound(std::span<const Hypothesis> hypotheses, const Eigen::MatrixXd& gram);

/// Probability that the mission leads to the true set and to no other: the share of simulated outcomes in which
/// the true hypothesis has at least `named_from` of the posterior probability. Draws have a fixed seed.
[[nodiscard]] double probability_exact(std::span<const Hypothesis> hypotheses, const Eigen::MatrixXd& gram,
                                       double named_from);

/// A parameter of an effect whose smallest strength is asked for.
struct TestedParameter {
  std::size_t effect = 0;
  std::string parameter;
  Eigen::Index column = 0;  ///< among the unknowns
  double typical = 1;       ///< unknown of strength 1
};
/// Smallest strength of each parameter, in typical values, that stands out by `nats` against all other unknowns
/// within tolerance; infinite where the missions do not show it. `gram`: of all missions together.
[[nodiscard]] Eigen::VectorXd smallest_strengths(const Eigen::MatrixXd& gram,
                                                 std::span<const TestedParameter> tested,
                                                 const Eigen::VectorXd& tolerances, double nats);

}  // namespace navcal::gap
