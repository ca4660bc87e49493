// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "identify/fit/estimate.h"

namespace navcal::identify {

/// What a manoeuvre would add to the recordings.
struct ManoeuvreAdvice {
  std::string manoeuvre;
  double seconds = 0;
  double gain_nats = 0;   ///< 1/2 log det of the covariance before over that after
  std::string parameter;  ///< whose standard error falls most, of those that are not told
  double std_before = 0, std_after = 0;
};

/// Manoeuvres of a small table, simulated with the layout and with the instruments of the first recording; those
/// that make an untold number at least a tenth better, best first. The information of a manoeuvre is that of its
/// filter without nuisances, divided by the estimate's model error.
[[nodiscard]] std::vector<ManoeuvreAdvice> advised_manoeuvres(const PredictionErrorProblem& problem,
                                                              const Estimate& estimate,
                                                              const EstimateSettings& settings,
                                                              const FitProgress& progress);

}  // namespace navcal::identify
