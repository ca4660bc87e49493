// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/simulated_motion.h"

#include "base/vectors.h"
#include "sim/layout/layout_of.h"
#include "sim/vehicle/motor_current.h"

namespace navcal::sim {

SimulatedMotion::SimulatedMotion(const config::VehicleSettings& vehicle, std::unique_ptr<Helm> helm,
                                 const MotionOptions& options)
    : SteppedMotion(options, helm->start()), vehicle_(layout_of(vehicle)), propeller_(vehicle.propeller),
      hull_(vehicle.hull), helm_(std::move(helm)), actuators_(helm_->actuators_at_start()) {}

void SimulatedMotion::take_step() const {
  Influences on = influences();
  if (options_.floats) on.buoyancy_N -= emerged(hull_.diameter_m) * hull_.mass_kg * kGravity_m_s2;
  const Actuators next = helm_->next(time_s(), kMotionStep_s, body());
  if (next.fins_ordered_rad)
    tell(orders_,
         Order{options_.start_ns + elapsed_ns(), 60 * next.shaft_commanded_rps, array_of(*next.fins_ordered_rad)});
  Controls held{next.fins_rad, actuators_.shaft_rps};
  if (options_.influencer != nullptr) {
    Vector3 fins_rad = array_of(next.fins_rad);
    options_.influencer->link_fins(time_s() + kMotionStep_s, kMotionStep_s, fins_rad);
    held.fins_rad = base::vector_of(fins_rad);
  }
  const Eigen::Vector3d linked_rad = held.fins_rad;
  if (!helm_->holds_over_steps()) {
    held.fins_rad = (linked_rad_.value_or(linked_rad) + linked_rad) / 2;
    held.shaft_rps = (actuators_.shaft_rps + next.shaft_rps) / 2;
  }
  linked_rad_ = linked_rad;
  const LayoutVehicle::Step step = vehicle_.step(body(), held.values(), kMotionStep_s, on);
  State state = state_of(step.acceleration, on);
  state.rpm_commanded = 60 * actuators_.shaft_commanded_rps;
  state.rpm = 60 * actuators_.shaft_rps;
  state.fins_rad = array_of(actuators_.fins_rad);
  state.motor_current_A = current_A(propeller_, actuators_.shaft_rps);
  actuators_ = next;
  end_step(state, step.body, helm_->finished());
}

}  // namespace navcal::sim
