// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "emulation/emulate_session.h"
#include "sim/instruments/actuator_outputs.h"
#include "sim/instruments/motor_card.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::emulation {

struct EmulatedMotion {
  std::unique_ptr<sim::Motion> motion;
  sim::MotorCard::Obey obey_card{};           ///< if it obeys the motor card
  sim::ActuatorOutputs::Obey obey_outputs{};  ///< if it obeys outputs
};

/// How the emulated vehicle moves from options.start_ns (UTC) on: by the orders of motor card or outputs, then in
/// real time; by a mission, along a path, or along the path that comes with the program. `options.influencer` must
/// outlive the motion; paths pass it over. Throws config::Error or Failure.
[[nodiscard]] EmulatedMotion emulate_motion(const EmulateArguments& arguments, sim::MotionOptions options);

}  // namespace navcal::emulation
