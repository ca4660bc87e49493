// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/library.h"

namespace navcal::gap {

/// Effects that may be at work together: indices into the library, in order.
using EffectSubset = std::vector<std::size_t>;

/// All parameters of these effects, among the unknowns.
[[nodiscard]] std::vector<Eigen::Index> parameter_indices(const Library& library, const EffectSubset& effects);

/// Of an effect with these values, in typical strengths: the norm of a vector's components, the largest of others.
[[nodiscard]] double strength_of(const Library& library, std::size_t effect, const Eigen::VectorXd& values);

}  // namespace navcal::gap
