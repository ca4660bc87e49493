// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gap/inference/problem.h"
#include "gap/inference/search.h"
#include "gap/nulls/backlash_null_bank.h"
#include "gap/verdict/prepare.h"

namespace navcal::gap {

/// Data that the steps of a diagnosis share once the recording is prepared. References, valid as long as the
/// diagnosis runs.
struct DiagnosisProblem {
  const Prepared& prepared;  ///< the recording, or the first of several
  const Library& library;
  const Request& request;
  const Progress& progress;
  unsigned threads = 1;
  /// Recordings that are diagnosed together with the first one, and their parts of the joint model, in the same
  /// order.
  std::span<const Prepared* const> others{};
  std::span<const JoinedRecording> joined{};

  /// Whitened residuals of all recordings.
  [[nodiscard]] ResidualModel model() const {
    ResidualModel all = prepared.model(library, threads);
    all.others = joined;
    return all;
  }
  /// Problem of the search, with one linearisation about the nominal vehicle and with priors.
  [[nodiscard]] InferenceProblem inference(const Linearised& nominal, const Priors& priors) const;
  /// Input of the null missions, for each recording.
  [[nodiscard]] std::vector<RepeatedMission> repeated() const;
};

/// The effects that a search found, and what they were compared with.
struct FoundEffects {
  SearchResult found;
  Priors priors;
  Linearised nominal;                             ///< about the nominal vehicle, of all recordings
  std::optional<BacklashNullBank> backlash_bank;  ///< when backlash was found
  EffectSubset unobservable;  ///< effects that the mission hardly shows: nuisance parameters of the search
  EffectSubset by_chance;     ///< effects that were found, and that null missions show as well

  /// Effects that were no candidates, because the instruments of the recording hardly show them.
  [[nodiscard]] const EffectSubset& not_judged() const { return priors.not_judged; }
};

/// The second step of a diagnosis: finds the most probable subset of effects. Backlash is judged by a null bank
/// of vehicles that have it, a subset of little evidence by null Bayes factors. Effects that the mission cannot
/// show become nuisance parameters of a second search. Where an instrument is silent, those that the others hardly
/// show are nuisance parameters from the first and no candidates.
[[nodiscard]] FoundEffects find_effects(const DiagnosisProblem& problem);

}  // namespace navcal::gap
