// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gap/inference/subset_evidence.h"
#include "gap/inference/whitening.h"

namespace navcal::gap {

/// Where no mission was held out: this one is cut into pieces of a minute; the even ones are predicted by what the
/// odd ones teach, and the other way round. By how much the log likelihood of each half grows with the effects,
/// nats.
[[nodiscard]] std::vector<double> gains_of_blocks(const EffectSubset& effects, const LinearGaussianModel& model,
                                                  const Layout& layout);

}  // namespace navcal::gap
