// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "diagnosis/held_out.h"
#include "diagnosis/nominal_bank.h"
#include "gap/verdict/diagnosis.h"

namespace navcal::diagnosis {

/// A cause with its sizes by an estimate of a set that has it.
[[nodiscard]] gap::EffectFinding finding_of(const Cause& cause, double probability,
                                            const SetEvidence::Posterior& estimate);

/// Channels whose noise power exceeds that of nominal recordings, most first.
[[nodiscard]] std::vector<gap::WhereEntry> louder_channels(const RecordingPower& power,
                                                           std::span<const RecordingPower> nominal);

/// What a verdict rests on. The parts must outlive it.
struct LayoutEvidence {
  const CauseLibrary& library;
  const NominalBank& bank;
  const CauseSearchResult& found;
  const RecordingPower& after;                   ///< of the recording with the causes found
  std::span<const ExplainedRecording> held_out;  ///< may be none
  /// Share of the gap that goes away with a set of causes.
  std::function<gap::Closure(const CauseSet&)> closure = {};
  double before = 0;  ///< noise power of the recording without causes
};

/// Closes `answer`, whose figures of the gap are those of the best set: writes verdict, sentence, effects,
/// candidates and what stays unexplained (docs/gap.md, "Vehicles with a layout"). Without a gap it removes the
/// entries of `where`.
void write_verdict(const LayoutEvidence& evidence, gap::Diagnosis& answer);

}  // namespace navcal::diagnosis
