// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "analysis/emulate_session.h"
#include "analysis/ordered_motion.h"
#include "sim/instruments/actuator_outputs.h"
#include "sim/instruments/motor_card.h"
#include "sim/state.h"

namespace navcal::analysis {

struct EmulatedMotion {
  std::unique_ptr<sim::Motion> motion;
  sim::MotorCard::Obey obey_card{};           ///< if it obeys the motor card
  sim::ActuatorOutputs::Obey obey_outputs{};  ///< if it obeys outputs
};

/// How the emulated vehicle moves from start_ns (UTC) on: by the orders of motor card or outputs, by a mission,
/// along a path, or along the path that comes with the program. `influencer` must outlive the motion; paths pass
/// it over. `now_ns` gives UTC. Throws sim::BadPath, config::Error or Failure.
[[nodiscard]] EmulatedMotion emulate_motion(const EmulateArguments& arguments, std::int64_t start_ns,
                                            sim::VehicleInfluencer& influencer,
                                            std::function<std::int64_t()> now_ns);

}  // namespace navcal::analysis
