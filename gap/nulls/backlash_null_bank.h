// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/inference/model_fit.h"
#include "gap/inference/spike_and_slab.h"
#include "gap/nulls/null_bank.h"

namespace navcal::gap {

/// Simulated missions of vehicles that have no gap but the backlash that was found, and are replayed with it.
/// Inside the dead band a fin's position depends on where its servo last reversed. Reports ten times a second
/// resolve that poorly, and null missions without backlash do not contain the error.
struct BacklashNullBank {
  int missions = 0;
  RegimeStatistics explained_rms;  ///< of the replays
  Eigen::MatrixXd scores;          ///< design^T innovations: a column for each mission
  /// Of all unknowns: by how much the widths are found too large, and how that scatters; zero for all others.
  Eigen::VectorXd excess, scatter;
};

/// Whether any of these effects is a backlash.
[[nodiscard]] bool has_backlash(const Library& library, const EffectSubset& effects);

/// `found` says how wide the backlash is; `model` is that of the recorded mission. Missions that no such vehicle
/// could follow are left out.
[[nodiscard]] BacklashNullBank backlash_null_bank(const ModelFit& found, const RepeatedMission& repeated,
                                                  const ResidualModel& model, const BankOptions& options);

/// `priors`, widened so that what the bank's missions show of other effects is within tolerance.
[[nodiscard]] Priors widened(Priors priors, const Library& library, const ModelFit& found,
                             const BacklashNullBank& bank);

/// Corrects the width, which fits the replay, by the bank's mean error; its standard error gets their scatter.
void correct(ModelFit& found, const Library& library, const BacklashNullBank& bank);

}  // namespace navcal::gap
