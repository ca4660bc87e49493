#pragma once

#include <Eigen/Core>

#include "gap/library.h"

namespace navcal::gap {

/// Standard deviations of the priors of all unknowns. Slab: what an effect of typical strength may be. Spike: what
/// a vehicle within tolerance shows of it. Biases have one and the same wide prior.
struct Priors {
  Eigen::VectorXd spike, slab;
};

/// Spikes are those under which the bank's missions (`scores`, a column each) are most probable (empirical Bayes,
/// by expectation and maximisation), but not below 3 % of the typical strength. What the model does not describe
/// (the fins between two reports, say) is in them.
[[nodiscard]] Priors learnt_priors(const Library& library, const Eigen::MatrixXd& gram,
                                   const Eigen::MatrixXd& scores);

}  // namespace navcal::gap
