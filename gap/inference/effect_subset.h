// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/library.h"

namespace navcal::gap {

/// Effects that act together: indices into the library, in order.
using EffectSubset = std::vector<std::size_t>;

/// Indices of all parameters of these effects among the unknowns.
[[nodiscard]] std::vector<Eigen::Index> parameter_indices(const Library& library, const EffectSubset& effects);

/// Strength of an effect with these values, in typical values: the norm of the components of a vector, the
/// largest component of any other effect.
[[nodiscard]] double strength_of(const Library& library, std::size_t effect, const Eigen::VectorXd& values);

}  // namespace navcal::gap
