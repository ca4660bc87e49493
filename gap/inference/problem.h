// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "gap/inference/linearised.h"
#include "gap/inference/spike_and_slab.h"
#include "gap/inference/subset_evidence.h"

namespace navcal::gap {

/// The question that an inference answers: which effects explain one recording. References; valid as long as what
/// they refer to.
struct InferenceProblem {
  ResidualModel model;
  const Linearised& nominal;  ///< about the nominal vehicle with the turn-on biases of the recording
  const Priors& priors;
  /// Gets the share that is done, 0 to 1; from one thread at a time.
  std::function<void(double)> progress = [](double) {};

  /// Another linearisation with the same priors.
  [[nodiscard]] LinearGaussianModel about(const Linearised& linear) const {
    return {linear, model.library, priors};
  }
};

}  // namespace navcal::gap
