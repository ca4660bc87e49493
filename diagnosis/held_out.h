// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "diagnosis/cause_search.h"
#include "gap/verdict/diagnosis.h"

namespace navcal::diagnosis {

/// A recording without the causes found, and with them. Windows have sums of squares of the whitened residuals.
struct ExplainedWindows {
  double gain_nats = 0;  ///< by the causes; negative infinity where the vehicle could not have moved with them
  std::vector<double> before, after, readings;
};

/// Predicts a held-out recording with the estimate of the most probable set. `without`: its fit without a cause.
[[nodiscard]] ExplainedWindows held_out(const FittedRecording& recording, const RecordingFit& without,
                                        const CauseLibrary& library, const ColumnPriors& priors,
                                        const CauseSearchResult& found);

/// How much of the gap goes away in some recordings together; the interval by drawing windows anew. `floor`: noise
/// power of nominal recordings.
[[nodiscard]] gap::Closure closure_of(std::span<const ExplainedWindows> recordings, double floor,
                                      std::uint64_t seed);

}  // namespace navcal::diagnosis
