// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "analysis/noise/allan.h"
#include "analysis/noise/spectrum.h"

/// White noise N, bias instability B and random walk K from an Allan deviation (IEEE Std 952, annex C):
///
///     AVAR(tau) = N^2 / tau + B^2 2 ln 2 / pi + K^2 (tau / 3 + tau0^2 / (6 tau)) + lines.
///
/// The last part of K^2 is there because readings are samples of the walk, tau0 apart, and not means of it. Of
/// readings with correlation a from one to the next, N^2 / tau of m readings has the factor 1 - a (1 - a^m) (3 -
/// a^m) / (m (1 - a^2)). N is the root of the two-sided power density (of a rate: the angle random walk);
/// independent readings of standard deviation s at intervals tau0 have N = s sqrt(tau0). B is 1/0.664 of the level
/// of the flat part. Spectral lines are known terms: A^2 sin^4(pi f m tau0) / (m sin(pi f tau0))^2.
///
/// N^2, B^2 and K^2 are fitted by least squares, weighted by the model's own variance 2 AVAR^2 / edf and repeated
/// until they agree. The covariance takes into account that neighbouring points are correlated. Among the sets of
/// terms whose values are all positive and above three standard errors, the one with the smallest deviance counts,
/// with a penalty for each term.
namespace navcal::analysis {

/// A term of the model, in units of N, B or K. Either a value with its standard error, or why there is none.
struct NoiseTerm {
  std::optional<double> value, error;
  std::optional<double> limit;  ///< without a value: 95 % upper limit
  /// Without a value: length of a recording at rest that would show a term of the size of the limit (or, without a
  /// limit, any term). nullopt where a longer recording does not help.
  std::optional<double> needs_s;
};

struct AllanFit {
  NoiseTerm white, flicker, walk;
};

/// Fits `points` from tau >= `shortest_s` on (filters of a higher order spoil shorter ones). `lag1`: the
/// correlation of readings behind a first-order filter, from 0 to below 1. Sets the confidence intervals of all
/// points by the kind of noise that dominates there.
[[nodiscard]] AllanFit fit_allan(std::vector<AllanPoint>& points, const Pieces& pieces, double period_s,
                                 double shortest_s, double lag1, const std::vector<SpectralLine>& lines);

}  // namespace navcal::analysis
