// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "gap/inference/subset_evidence.h"
#include "gap/inference/whitening.h"

namespace navcal::gap {

/// Whether a row of `rows` whitened residuals is from an even minute of the mission; of fixes, whether it is from
/// their first half.
[[nodiscard]] bool is_in_even_minute(Eigen::Index row, const Layout& layout, Eigen::Index rows);

/// Cross-validation within one mission, where no other one was held out. The mission is cut into pieces of a
/// minute. The even pieces are predicted with parameters fitted to the odd ones, and the other way round.
/// Returns the gain in log likelihood of each half by the effects, nats.
[[nodiscard]] std::vector<double> gains_of_blocks(const EffectSubset& effects, const LinearGaussianModel& model,
                                                  const Layout& layout);

/// Cross-validation among several recordings: each is predicted with parameters fitted to the others. `rows`:
/// number of residuals of each. Returns the gain in log likelihood of each by the effects, nats.
[[nodiscard]] std::vector<double> gains_of_recordings(const EffectSubset& effects,
                                                      const LinearGaussianModel& model,
                                                      std::span<const Eigen::Index> rows);

}  // namespace navcal::gap
