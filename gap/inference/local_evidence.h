// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/inference/model_fit.h"
#include "gap/inference/subset_evidence.h"

namespace navcal::gap {

/// Log evidence of subsets by one linearisation, minus the penalty of the parameters' bounds, plus the
/// simulated fit's gain over the linear model. The values of several linearisations may be compared.
class LocalEvidence {
 public:
  /// Keeps references to what `model` refers to. `beyond_linear`: ModelFit::beyond_linear of the subset about
  /// which it was linearised, nats.
  LocalEvidence(const LinearGaussianModel& model, double beyond_linear)
      : model_(model), beyond_linear_(beyond_linear), evidence_(model) {}

  [[nodiscard]] double operator()(const EffectSubset& subset) const {
    return evidence_(subset) - bound_penalty_nats(subset, model_) + beyond_linear_;
  }

 private:
  LinearGaussianModel model_;
  double beyond_linear_;
  SubsetEvidence evidence_;
};

}  // namespace navcal::gap
