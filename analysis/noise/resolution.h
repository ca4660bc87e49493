// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace navcal::analysis {

/// The step by which readings are rounded: the greatest common divisor of the differences between the values that
/// occur. nullopt for fewer than two distinct values, and where the differences have no common divisor that is
/// large against the precision of the numbers. Same unit as the values.
[[nodiscard]] std::optional<double> resolution_of(std::vector<double> values);

}  // namespace navcal::analysis
