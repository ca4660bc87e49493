// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "gap/inference/library.h"
#include "gap/replay/replay.h"

namespace navcal::gap {

/// What null missions repeat. References; valid as long as what they refer to.
struct RepeatedMission {
  const Replay& recorded;
  const Trajectory10Hz& course;  ///< of the nominal vehicle in the recorded mission
  const config::VehicleSettings& vehicle;
};

/// The recorded mission once more, by a simulated vehicle without a gap: as the recorded one was steered, with
/// the instruments of the recording through their bytes and the pipeline, and with fixes when it had some. The
/// gyros have no turn-on bias. Throws sim::UnstableVehicle.
[[nodiscard]] Mission null_mission(const RepeatedMission& repeated, const sim::EffectSet& mismatch,
                                   std::uint64_t seed);

/// Values of all unknowns of a vehicle within tolerance; biases are zero.
[[nodiscard]] Eigen::VectorXd benign_mismatch(const Library& library, std::uint64_t seed);

}  // namespace navcal::gap
