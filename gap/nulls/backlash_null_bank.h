// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/inference/model_fit.h"
#include "gap/inference/spike_and_slab.h"
#include "gap/nulls/null_bank.h"

namespace navcal::gap {

/// Simulated missions of vehicles that have no gap but the play that was found, and are replayed with it. Where
/// the fins stand in their play follows from the servos' turning points, of which reports ten times a second say
/// little; what is wrong there stays until the next turn, and vehicles without play know nothing of it.
struct BacklashNullBank {
  int missions = 0;
  RegimeStatistics explained_rms;  ///< of the replays
  Eigen::MatrixXd scores;          ///< design^T innovations: a column for each mission
  /// Of all unknowns: by how much the widths are found too large, and how they scatter; zero for all others.
  Eigen::VectorXd excess, scatter;
};

/// Whether any of these effects is a play.
[[nodiscard]] bool has_play(const Library& library, const EffectSubset& effects);

/// `recorded` is steered by, `found` says how wide the play is. Missions that no such vehicle could follow are not
/// among them.
[[nodiscard]] BacklashNullBank backlash_null_bank(const Replay& recorded, const Trajectory10Hz& course,
                                                  const config::VehicleSettings& vehicle, const Library& library,
                                                  const Whitening& whitening, const ModelFit& found,
                                                  const BankOptions& options);

/// Priors by which what the twins show of other effects is no more than tolerance.
[[nodiscard]] Priors with_twins(Priors priors, const Library& library, const ModelFit& found,
                                const BacklashNullBank& twins);

/// The width that serves in the replay becomes the vehicle's, by what its twins had.
void correct(ModelFit& found, const Library& library, const BacklashNullBank& twins);

}  // namespace navcal::gap
