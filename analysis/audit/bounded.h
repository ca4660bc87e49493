// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace navcal::analysis {

/// A value with its 95 % interval.
struct Bounded {
  double value = 0, low = 0, high = 0;
};

/// value +- 1.96 std.
[[nodiscard]] Bounded bounded(double value, double std);

/// Mean of numbers that do not depend on each other, such as means of long blocks; by Student's t. nullopt for
/// fewer than four.
[[nodiscard]] std::optional<Bounded> mean_bounded(const std::vector<double>& numbers);

/// Means of `values` in blocks of equal length in time. Blocks with fewer than `least` values are left out.
[[nodiscard]] std::vector<double> block_means(const std::vector<double>& time_s, const std::vector<double>& values,
                                              std::size_t least = 5, std::size_t blocks = 10);

/// Root of the mean square, with the interval from ten blocks. nullopt for fewer than four blocks.
[[nodiscard]] std::optional<Bounded> root_mean_square_bounded(const std::vector<double>& time_s,
                                                              std::vector<double> values);

}  // namespace navcal::analysis
