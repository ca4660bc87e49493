// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
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
  double log_odds = 0;            ///< against its absence, with all other causes in place, nats
  double probability = 0;         ///< of the effect at this level and unit, whenever it began
  double probability_of_time = 0; ///< of its first and last mission, if the effect is right
  Eigen::VectorXd mean, std;      ///< of its parameters, typical values
  std::vector<Alternative> alternatives;  ///< from kAlternativeFrom on, most probable first
};

/// Gets the share that is done, 0 to 1.
using CauseProgress = std::function<void(double)>;

/// Finds the causes that explain the missions best: one after the other, then each against all others in its place.
[[nodiscard]] std::vector<FoundCause> find_causes(const PooledMissions& missions, unsigned threads,
                                                  const CauseProgress& progress);

}  // namespace navcal::fleet
