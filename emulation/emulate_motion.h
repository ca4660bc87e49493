// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "emulation/emulate_session.h"
#include "sim/instruments/actuator_outputs.h"
#include "sim/instruments/motor_card.h"
#include "sim/state.h"

namespace navcal::emulation {

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

/// A simulated vehicle that obeys orders in real time. It is never taken further ahead than the time that it is:
/// what it does next depends on orders that have not come.
class OrderedMotion final : public sim::Motion {
 public:
  /// `now_ns` gives UTC.
  OrderedMotion(std::unique_ptr<sim::Motion> motion, std::function<std::int64_t()> now_ns)
      : motion_(std::move(motion)), now_ns_(std::move(now_ns)) {}

  /// The state at t_ns; for a time to come, the state now. Throws UnstableVehicle.
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override { return motion_->at(std::min(t_ns, now_ns_())); }
  void take_outputs(std::int64_t t_ns, std::vector<sim::OutputOrder>& out) const override {
    motion_->take_outputs(std::min(t_ns, now_ns_()), out);
  }

 private:
  std::unique_ptr<sim::Motion> motion_;
  std::function<std::int64_t()> now_ns_;
};

}  // namespace navcal::emulation
