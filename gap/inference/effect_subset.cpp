// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/effect_subset.h"

#include <algorithm>
#include <cmath>

namespace navcal::gap {

std::vector<Eigen::Index> parameter_indices(const Library& library, const EffectSubset& effects) {
  std::vector<Eigen::Index> members;
  for (const std::size_t effect : effects) {
    for (Eigen::Index k = 0; k < library.count(effect); ++k) members.push_back(library.first(effect) + k);
  }
  return members;
}

double strength_of(const Library& library, std::size_t effect, const Eigen::VectorXd& values) {
  double square = 0, largest = 0;
  for (Eigen::Index k = 0; k < library.count(effect); ++k) {
    const Eigen::Index j = library.first(effect) + k;
    const double part = values[j] / library.unknowns()[static_cast<std::size_t>(j)].typical;
    square += part * part;
    largest = std::max(largest, std::abs(part));
  }
  return library[effect].vector > 1 ? std::sqrt(square) : largest;
}

}  // namespace navcal::gap
