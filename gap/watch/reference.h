// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "config/vehicle.h"
#include "devices/instrument_model.h"
#include "gap/data/earth_field.h"
#include "gap/inference/library.h"
#include "gap/nulls/null_bank.h"
#include "gap/replay/regimes.h"
#include "gap/watch/change_detector.h"

namespace navcal::gap {

/// What a watch compares windows with: the residuals of simulated vehicles without a gap. Their mission contains
/// straight legs, turns, changes of speed, dives and surfacings, because the mission to be watched is not known.
struct WatchReference {
  NullBank bank;  ///< of the reference mission
  Priors priors;
  double noise_factor = 1;         ///< mean power of the windows of null missions
  PowerDetector power;             ///< before its first window
  RegimeStatistics explained_rms;  ///< of single windows
  int windows = 0;                 ///< on which these statistics rest
};

/// Input of a reference. References; valid as long as what they refer to.
struct ReferenceRequest {
  const config::VehicleSettings& vehicle;
  const Library& library;
  devices::InstrumentModel instruments;
  EarthField field;
  std::filesystem::path cache;  ///< folder of null banks; empty: none are kept
  BankOptions bank;
};

/// Simulates the null missions, or finds their bank in the cache, and takes the statistics of their windows.
/// `progress` gets the share that is done. Throws sim::UnstableVehicle, and std::runtime_error when too few
/// simulated vehicles can sail the reference mission.
[[nodiscard]] WatchReference make_reference(const ReferenceRequest& request,
                                            const std::function<void(double)>& progress);

}  // namespace navcal::gap
