// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "gap/inference/library.h"
#include "gap/replay/replay.h"

namespace navcal::gap {

/// Input of null missions. References; valid as long as what they refer to.
struct RepeatedMission {
  const Replay& recorded;
  const Trajectory10Hz& course;  ///< of the nominal vehicle in the recorded mission
  const config::VehicleSettings& vehicle;
};

/// Repeats the recorded mission with a simulated vehicle without a gap. The vehicle is steered as the recorded
/// one was. The instruments of the recording are simulated down to their bytes and read by the pipeline. Fixes
/// occur where the recording has them. The gyros have no turn-on bias. Throws sim::UnstableVehicle.
[[nodiscard]] Mission null_mission(const RepeatedMission& repeated, const sim::EffectSet& mismatch,
                                   std::uint64_t seed);

/// Draws the values of all unknowns of a vehicle within tolerance; biases are zero.
[[nodiscard]] Eigen::VectorXd benign_mismatch(const Library& library, std::uint64_t seed);

}  // namespace navcal::gap
