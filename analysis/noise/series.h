// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace navcal::analysis {

/// Readings of one channel with their times of validity, in the order in which they came.
struct Series {
  std::vector<double> time_s, values;  ///< of equal length; the values are finite
};

/// Part of a recording, in seconds from its beginning.
struct Interval {
  double from_s = 0, to_s = 0;
  [[nodiscard]] double length_s() const { return to_s - from_s; }
};

/// Readings that follow one another without a gap, one list for each stretch of the recording.
using Pieces = std::vector<std::vector<double>>;

/// Median of the times between readings; 0 for fewer than two readings or where time does not advance.
[[nodiscard]] double median_period_s(const Series& series);

/// The readings within the intervals, cut where a reading is missing: where the time to the next one is longer
/// than 1.6 periods, or does not advance. Pieces of fewer than two readings are left out.
[[nodiscard]] Pieces pieces_of(const Series& series, const std::vector<Interval>& intervals, double period_s);

/// Mean period within the pieces that pieces_of() makes: less affected by jitter than the median. 0 without
/// pieces.
[[nodiscard]] double mean_period_s(const Series& series, const std::vector<Interval>& intervals, double period_s);

/// The value that `share` of the numbers lie below; 0 without numbers.
[[nodiscard]] double quantile(std::vector<double> numbers, double share);
[[nodiscard]] std::size_t reading_count(const Pieces& pieces);
[[nodiscard]] double mean_of(const Pieces& pieces);

/// The step by which readings are rounded: the greatest common divisor of the differences between the values that
/// occur. nullopt for fewer than two distinct values, and where the differences have no common divisor that is
/// large against the precision of the numbers. Same unit as the values.
[[nodiscard]] std::optional<double> resolution_of(std::vector<double> values);

}  // namespace navcal::analysis
