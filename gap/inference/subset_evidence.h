// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/inference/effect_subset.h"
#include "gap/inference/evidence.h"
#include "gap/inference/linearised.h"
#include "gap/inference/spike_and_slab.h"

namespace navcal::gap {

/// One linearisation with the priors of its unknowns: a Gaussian model whose posteriors are closed forms.
/// References; valid as long as what they refer to.
struct LinearGaussianModel {
  const Linearised& linear;
  const Library& library;
  const Priors& priors;
};

/// Evidence referred to no effects, whatever the point of linearisation.
[[nodiscard]] Evidence evidence_of(const Linearised& linear, const Priors& priors);

/// Log evidence of subsets. It is referred to the nominal vehicle whatever the point of linearisation, so that
/// values of several linearisations may be compared.
class SubsetEvidence {
 public:
  /// The model's library must outlive it.
  explicit SubsetEvidence(const LinearGaussianModel& model);

  /// Log joint probability of subset and data, nats, apart from a constant.
  [[nodiscard]] double operator()(const EffectSubset& set) const;

 private:
  [[nodiscard]] double gain(const EffectSubset& set) const;

  const Library& library_;
  Evidence evidence_;
  double data_;
};

}  // namespace navcal::gap
