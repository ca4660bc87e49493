// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/noise/series.h"

/// The overlapping Allan deviation of readings that come at equal times tau0 apart (IEEE Std 1139; Riley, NIST
/// Special Publication 1065, 2008, equation 11). With x_i the sum of the readings before the i-th,
///
///     AVAR(m tau0) = 1 / (2 m^2 M) sum_i (x_(i+2m) - 2 x_(i+m) + x_i)^2,
///
/// over all M places where 2m readings follow one another without a gap. The confidence interval takes the
/// estimate as a chi-squared variable with the equivalent degrees of freedom of Howe, Allan and Barnes (1981),
/// which are also in NIST SP 1065, table 5; those of several stretches add.
namespace navcal::analysis {

/// Noise by the slope of its Allan deviation: white -1/2, flicker 0, random walk +1/2.
enum class NoiseKind { white, flicker, random_walk };

struct AllanPoint {
  std::size_t factor = 1;  ///< m
  double tau_s = 0;
  double deviation = 0;      ///< in the unit of the readings
  double edf = 0;            ///< equivalent degrees of freedom
  double low = 0, high = 0;  ///< 95 % confidence interval of the deviation
};

/// The deviation at tau = 1, 2, 4, 8, ... periods, up to half of the longest piece. Confidence intervals are those
/// of white noise. Empty for pieces of fewer than two readings or a period that is not positive.
[[nodiscard]] std::vector<AllanPoint> allan_deviation(const Pieces& pieces, double period_s);

/// Equivalent degrees of freedom of the overlapping Allan variance of `readings` readings at factor m; at least 1
/// when there are 2m readings, else 0.
[[nodiscard]] double allan_edf(NoiseKind kind, std::size_t readings, std::size_t factor);
/// The sum over all pieces.
[[nodiscard]] double allan_edf(NoiseKind kind, const Pieces& pieces, std::size_t factor);

/// Sets degrees of freedom and confidence interval.
void set_confidence(AllanPoint& point, double edf);

}  // namespace navcal::analysis
