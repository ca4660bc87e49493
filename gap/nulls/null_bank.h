// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "gap/inference/library.h"
#include "gap/inference/linearised.h"
#include "gap/inference/whitening.h"
#include "gap/nulls/null_mission.h"
#include "gap/replay/regimes.h"
#include "gap/replay/replay.h"

namespace navcal::gap {

/// Statistics of simulated missions without a gap that were steered as the recorded one: the reference of every
/// comparison in a diagnosis.
struct NullBank {
  int missions = 0;
  std::uint64_t seed = 0;
  double seconds = 0;  ///< computing time of the bank

  Whitening whitening;
  Eigen::MatrixXd gram;            ///< of the design of the recorded mission, of all unknowns of the whole library
  Eigen::MatrixXd scores;          ///< design^T innovations: a column for each mission
  std::vector<double> powers;      ///< mean square of whitened innovations of each mission, biases fitted
  RegimeStatistics explained_rms;  ///< of the nominal replay of each
  RegimeStatistics left;           ///< of the replays of some by their own true parameters
};

/// Innovations in the shape of another mission that was steered alike: cut off, or filled with NaN.
[[nodiscard]] Innovations fitted_into(const Innovations& innovations, const Layout& layout);

struct BankOptions {
  int missions = 100;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// Simulates and replays null missions, and computes their statistics. The recorded mission only determines how
/// they are steered; its innovations are not used. `at`: values of all unknowns of `library` at which the
/// design is linearised. `progress` gets the share that is done.
[[nodiscard]] NullBank make_null_bank(const RepeatedMission& repeated, const Library& library,
                                      const Eigen::VectorXd& at, const BankOptions& options,
                                      const std::function<void(double)>& progress);

}  // namespace navcal::gap
