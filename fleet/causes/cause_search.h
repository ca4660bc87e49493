// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "fleet/causes/pooled_evidence.h"

namespace navcal::fleet {

/// Something else that could be there in the place of a cause.
struct Alternative {
  PossibleCause cause;  ///< times apart: the most probable ones stand for all
  double probability = 0;
};

/// A cause that was found.
struct FoundCause {
  ActingCause acting;
  double log_odds = 0;                    ///< against its absence, with all other causes in place, nats
  double probability = 0;                 ///< of the effect at this level and unit, whenever it began
  double probability_of_time = 0;         ///< of its first and last mission, if the effect is right
  Eigen::VectorXd mean, std;              ///< of its parameters, typical values
  std::vector<Alternative> alternatives;  ///< from kAlternativeFrom on, most probable first
};

/// What a search ended with.
struct CauseSearchResult {
  std::vector<FoundCause> causes;
  /// A vehicle for which more causes were found than a vehicle has (kMostCausesPerVehicle): what acts in it is not
  /// in the library. The search ends there, and is to be repeated without that vehicle. Empty: there is none.
  std::string outlier;
};

/// Gets the share that is done, 0 to 1.
using CauseProgress = std::function<void(double)>;

/// Finds the causes that explain the missions best: one after the other, then each against all others in its
/// place.
[[nodiscard]] CauseSearchResult find_causes(const PooledMissions& missions, unsigned threads,
                                            const CauseProgress& progress);

}  // namespace navcal::fleet
