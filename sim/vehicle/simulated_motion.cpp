// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/simulated_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/gravity.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/pulses.h"
#include "sim/rotation.h"
#include "sim/vehicle/motor_current.h"

namespace navcal::sim {
namespace {

constexpr std::int64_t kMotionStep_ns = 10'000'000;
constexpr double kMotionStep_s = 1e-9 * kMotionStep_ns;

double height_of(const config::Layout& layout) {
  if (layout.body.size_m[2] > 0) return layout.body.size_m[2];
  return std::cbrt(layout.body.buoyancy_N / (layout.water_density_kg_m3 * base::kGravity_m_s2));
}

Vector3 first_three(const ActuatorNumbers& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

SimulatedMotion::SimulatedMotion(config::Layout layout, std::unique_ptr<Helm> helm, const MotionOptions& options)
    : options_(options), nominal_(std::move(layout)), height_m_(height_of(nominal_)), vehicle_(nominal_),
      helm_(std::move(helm)), body_(helm_->start()) {
  actuators_.commands = actuators_.positions = helm_->positions_at_start();
  check_stable(body_, 0);
}

SimulatedMotion::SimulatedMotion(const config::VehicleSettings& vehicle, std::unique_ptr<Helm> helm,
                                 const MotionOptions& options)
    : SimulatedMotion(layout_of(vehicle), std::move(helm), options) {
  card_ = vehicle.propeller;
}

State SimulatedMotion::at(std::int64_t t_ns) const {
  const std::int64_t elapsed_ns = std::max<std::int64_t>(0, by_now(t_ns) - options_.start_ns);
  const std::int64_t step = elapsed_ns / kMotionStep_ns;
  while (steps_ < step + 2) take_step();
  const std::int64_t oldest = steps_ - static_cast<std::int64_t>(states_.size());
  if (step < oldest) return states_.front();
  const auto index = static_cast<std::size_t>(step - oldest);
  const double part =
      static_cast<double>(elapsed_ns - step * kMotionStep_ns) / static_cast<double>(kMotionStep_ns);
  return between(states_[index], states_[index + 1], part);
}

double SimulatedMotion::duration_s() const {
  while (!ended_s_) take_step();
  return *ended_s_;
}

void SimulatedMotion::change_layout(double time_s) const {
  if (options_.influencer == nullptr || time_s < next_change_s_) return;
  config::Layout layout = nominal_;
  options_.influencer->change_layout(time_s, layout);
  if (layout != vehicle_.layout()) vehicle_ = LayoutVehicle(std::move(layout));
  next_change_s_ = options_.influencer->next_layout_change_s(time_s);
}

void SimulatedMotion::take_step() const {
  const double time_s = static_cast<double>(steps_) * kMotionStep_s;
  const double end_s = time_s + kMotionStep_s;
  const std::int64_t time_ns = options_.start_ns + steps_ * kMotionStep_ns;
  change_layout(time_s);
  Influences on;
  if (options_.influencer != nullptr) options_.influencer->influence(time_s, on);

  const Actuators before = actuators_;
  actuators_.is_new_order = false;
  helm_->next(time_s, kMotionStep_s, body_, actuators_);
  if (!card_) {
    actuators_.commands = commands_of(nominal_, actuators_.pulses_us);
    if (steps_ * kMotionStep_ns % kOutputs_ns == 0) tell(outputs_, OutputOrder{time_ns, actuators_.pulses_us});
  } else if (actuators_.is_new_order) {
    const auto& [thrusters, surfaces_rad, ballasts, masses] = actuators_.commands;
    tell(orders_, Order{time_ns, thrusters[0], first_three(surfaces_rad)});
  }
  if (helm_->positions() == Helm::Positions::follow)
    actuators_.positions = follow(vehicle_.layout(), actuators_.positions, actuators_.commands, kMotionStep_s);

  LayoutVehicle::Held held = vehicle_.hold(held_over_step(before.positions, end_s), on);
  // Share of a floating hull that is out of the water, with the depth z of its origin.
  const double emerged = std::clamp(0.5 - body_.position_m.z() / height_m_, 0.0, 1.0);
  if (!card_ || options_.floats) held.restoring.net_weight_N += emerged * vehicle_.layout().body.buoyancy_N;
  const LayoutVehicle::Step step = vehicle_.held_step(body_, held, kMotionStep_s);

  states_.push_back(state_of(step.acceleration, on, before));
  ++steps_;
  if (static_cast<double>(states_.size()) * kMotionStep_s > options_.history_s && states_.size() > 2)
    states_.pop_front();
  body_ = step.body;
  check_stable(body_, end_s);
  if (!ended_s_ && helm_->finished()) ended_s_ = static_cast<double>(steps_) * kMotionStep_s;
}

ActuatorValues SimulatedMotion::held_over_step(ActuatorValues from, double end_s) const {
  ActuatorValues to = actuators_.positions;
  if (card_) {
    Vector3 fins_rad = first_three(to.surfaces_rad);
    if (options_.influencer != nullptr) options_.influencer->link_fins(end_s, kMotionStep_s, fins_rad);
    to.surfaces_rad = {fins_rad[0], fins_rad[1], fins_rad[2]};
    from.surfaces_rad = linked_rad_.value_or(to.surfaces_rad);
    linked_rad_ = to.surfaces_rad;
  }
  if (helm_->positions() != Helm::Positions::held) return mean_of(from, to);
  to.thrusters = from.thrusters;
  return to;
}

State SimulatedMotion::state_of(const Vector6& acceleration, const Influences& influences,
                                const Actuators& actuators) const {
  State state;
  set_motion(state, body_, acceleration);
  state.field_world_uT = options_.field_world_uT;
  state.current_m_s = influences.current_m_s;
  state.water_temperature_C = water_temperature_C(state.position_m[2]);
  if (!card_) return state;
  state.rpm_commanded = actuators.commands.thrusters[0];
  state.rpm = actuators.positions.thrusters[0];
  state.fins_rad = first_three(actuators.positions.surfaces_rad);
  state.motor_current_A = current_A(*card_, state.rpm / 60);
  return state;
}

template <class Told>
void SimulatedMotion::tell(std::deque<Told>& waiting, Told told) const {
  waiting.push_back(std::move(told));
  while (1e-9 * static_cast<double>(waiting.back().time_ns - waiting.front().time_ns) > options_.history_s)
    waiting.pop_front();
}

void set_motion(State& state, const Body& body, const Vector6& acceleration) {
  state.position_m = array_of(body.position_m);
  state.euler_rad = array_of(body.euler_rad);
  state.velocity_body_m_s = array_of(body.velocity.head<3>());
  state.rate_rad_s = array_of(body.velocity.tail<3>());
  state.specific_force_m_s2 =
      specific_force(state.euler_rad, state.velocity_body_m_s, state.rate_rad_s, array_of(acceleration.head<3>()));
}

}  // namespace navcal::sim
