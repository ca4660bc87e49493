// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/set_evidence.h"
#include "diagnosis/settling.h"

namespace navcal::diagnosis {

struct ScoredSet {
  CauseSet causes;  ///< empty: no effect
  double log_odds = 0;
  double probability = 0;
};

struct CauseSearchResult {
  std::vector<ScoredSet> sets;  ///< most probable first
  RecordingFit best;            ///< fitted with the causes of the first one
  Likelihood none;              ///< of departures without a cause, about the best of them
  Likelihood changes;           ///< of the nominal vehicle, in `best`
};

/// Searches sets of at most kMostEffects causes. All singles and pairs are scored with the linearisation of the
/// nominal vehicle; the leaders are fitted again at their own estimate, because large effects are not linear, and
/// score their larger neighbours. Behind a gap that leads the nominal vehicle's filter astray, the recording holds
/// the gains of the best set. Throws std::invalid_argument where the nominal vehicle cannot follow.
[[nodiscard]] CauseSearchResult search_causes(RecordingModel& recording, const JointPrior& prior,
                                              const CauseLibrary& library, const Progress& progress);

}  // namespace navcal::diagnosis
