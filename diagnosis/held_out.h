// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "diagnosis/cause_search.h"
#include "gap/verdict/diagnosis.h"

namespace navcal::diagnosis {

/// A recording without the causes found, and with them.
struct ExplainedRecording {
  double gain_nats = 0;             ///< by the causes; negative infinity where the vehicle could not have moved so
  std::vector<double> member_nats;  ///< that each of them adds to the others
  RecordingPower before, after;
};

/// Predicts a held-out recording with the estimate of the most probable set.
[[nodiscard]] ExplainedRecording held_out(RecordingModel& recording, const JointPrior& prior,
                                          const CauseLibrary& library, const CauseSearchResult& found);

/// How much of the gap goes away in some recordings together; the interval by drawing blocks anew. `floor`: noise
/// power of nominal recordings.
[[nodiscard]] gap::Closure closure_of(std::span<const ExplainedRecording> recordings, double floor,
                                      std::uint64_t seed);

}  // namespace navcal::diagnosis
