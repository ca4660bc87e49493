// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "gap/design/planned_run.h"
#include "gap/inference/library.h"
#include "gap/inference/whitening.h"

namespace navcal::gap {

/// What a mission is rehearsed with. References; valid as long as what they refer to.
struct RehearsalProblem {
  const config::VehicleSettings& vehicle;
  const Library& library;
  const Whitening& whitening;  ///< of the recordings' null bank
  PlannedInstruments instruments;
  /// Point of linearisation: zero but for curved effects (Library::is_curved), whose regressors at zero do not
  /// describe their usual strength.
  Eigen::VectorXd at;
  unsigned threads = 1;
};

/// Gram matrices of the design of a simulated mission.
struct Rehearsal {
  Eigen::MatrixXd gram;                ///< of the whole mission
  std::vector<Eigen::MatrixXd> parts;  ///< of each part
};

/// Simulates a mission of the nominal vehicle, replays and linearises it. `part_began_s`: the begins of its parts,
/// in order; each ends where the next begins, the last with the mission. Throws sim::UnstableVehicle.
[[nodiscard]] Rehearsal rehearse(const RehearsalProblem& problem, const config::Mission& mission,
                                 double duration_s, std::span<const double> part_began_s);

}  // namespace navcal::gap
