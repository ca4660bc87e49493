// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/inference/model_fit.h"
#include "gap/inference/spike_and_slab.h"
#include "gap/nulls/null_bank.h"

namespace navcal::gap {

/// Simulated missions of vehicles that have no gap but the backlash that was found. They are replayed with that
/// backlash.
///
/// Inside the dead band a fin's position depends on where its servo last reversed. Reports ten times a second
/// resolve that poorly, and null missions without backlash do not contain the error.
struct BacklashNullBank {
  int missions = 0;
  RegimeStatistics explained_rms;  ///< of the replays
  Eigen::MatrixXd scores;          ///< design^T innovations: a column for each mission
  /// Mean error of the estimated widths (positive: too large), and its standard deviation; zero for all other
  /// unknowns.
  Eigen::VectorXd excess, scatter;
};

/// Whether any of these effects is a backlash.
[[nodiscard]] bool has_backlash(const Library& library, const EffectSubset& effects);

/// Makes the bank. `found` gives the width of the backlash; `model` is that of the recorded mission. Vehicles
/// that cannot follow the recorded mission are left out.
[[nodiscard]] BacklashNullBank backlash_null_bank(const ModelFit& found, const RepeatedMission& repeated,
                                                  const ResidualModel& model, const BankOptions& options);

/// Widens `priors` so that the other effects that the bank's missions show are within tolerance.
[[nodiscard]] Priors widened(Priors priors, const Library& library, const ModelFit& found,
                             const BacklashNullBank& bank);

/// Subtracts the bank's mean error from the estimated width, and adds the scatter of that error to its standard
/// error.
void correct(ModelFit& found, const Library& library, const BacklashNullBank& bank);

}  // namespace navcal::gap
