// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "gap/inference/library.h"

namespace navcal::gap {

/// Standard deviations of the priors of all unknowns. Slab: what an effect of typical strength may be. Spike: what
/// a vehicle within tolerance shows of it. Biases have one and the same wide prior.
struct Priors {
  Eigen::VectorXd spike, slab;
  /// Of each unknown: by how much more the bank's missions scatter than their tolerances. What the replay does not
  /// describe (the fins between two reports, say) is in there, and no longer mission makes it less.
  Eigen::VectorXd model_error;
};

/// Spikes are those under which the bank's missions (`scores`, a column each) are most probable (empirical Bayes,
/// by expectation and maximisation), but not below the tolerance that the bank was made with.
[[nodiscard]] Priors fit_spike_widths(const Library& library, const Eigen::MatrixXd& gram,
                                      const Eigen::MatrixXd& scores);

}  // namespace navcal::gap
