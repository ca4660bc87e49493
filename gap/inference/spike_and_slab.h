// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "gap/inference/effect_subset.h"
#include "gap/inference/library.h"

namespace navcal::gap {

/// Standard deviations of the priors of all unknowns. Slab: an effect of typical strength. Spike: a vehicle
/// within tolerance. Biases have the same wide prior in both.
struct Priors {
  Eigen::VectorXd spike, slab;
  /// Scatter of the bank's missions beyond their tolerances, for each unknown. It comes from what the replay
  /// does not describe, such as the fins between two reports, and a longer mission does not reduce it.
  Eigen::VectorXd model_error;
  EffectSubset not_judged{};  ///< effects that are no candidates, because the instruments hardly show them
};

/// Spike widths that maximise the likelihood of the bank's missions (`scores`, a column each), by empirical
/// Bayes with expectation-maximisation. No spike is narrower than the tolerance that the bank was made with.
[[nodiscard]] Priors fit_spike_widths(const Library& library, const Eigen::MatrixXd& gram,
                                      const Eigen::MatrixXd& scores);

/// Effects of which the mission shows less than kObservable_nats, at their typical strength and in any of their
/// parameters. `gram` is that of the design.
[[nodiscard]] EffectSubset hardly_shown_effects(const Library& library, const Eigen::MatrixXd& gram,
                                                const Priors& priors);

}  // namespace navcal::gap
