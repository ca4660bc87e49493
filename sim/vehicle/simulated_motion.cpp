// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/simulated_motion.h"

#include <algorithm>

#include "sim/layout/layout_of.h"
#include "sim/rotation.h"
#include "sim/vehicle/motor_current.h"

namespace navcal::sim {
namespace {

constexpr double kStep_s = kMotionStep_s;

Vector3 array_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

SimulatedMotion::SimulatedMotion(const config::VehicleSettings& vehicle, std::unique_ptr<Helm> helm,
                                 const MotionOptions& options)
    : vehicle_(layout_of(vehicle)), propeller_(vehicle.propeller), options_(options), helm_(std::move(helm)),
      body_(helm_->start()), actuators_(helm_->actuators_at_start()), states_(options.history_s) {
  check_stable(body_, 0);
}

State SimulatedMotion::at(std::int64_t t_ns) const {
  const std::int64_t elapsed_ns = t_ns - options_.start_ns;
  while (states_.steps() < StepHistory::steps_for(elapsed_ns)) take_step();
  return states_.at(elapsed_ns);
}

void SimulatedMotion::take_orders(std::int64_t t_ns, std::vector<Order>& out) const {
  (void)at(t_ns);
  for (; !orders_.empty() && orders_.front().time_ns <= t_ns; orders_.pop_front()) out.push_back(orders_.front());
}

double SimulatedMotion::duration_s() const {
  while (!ended_s_) take_step();
  return *ended_s_;
}

void SimulatedMotion::take_step() const {
  const std::int64_t steps = states_.steps();
  const double time_s = static_cast<double>(steps) * kStep_s;
  Influences influences;
  if (options_.influencer != nullptr) options_.influencer->influence(time_s, influences);
  const Actuators next = helm_->next(time_s, kStep_s, body_);
  if (next.fins_ordered_rad) {
    const std::int64_t time_ns = options_.start_ns + steps * kStep_ns;
    orders_.push_back({time_ns, 60 * next.shaft_commanded_rps, array_of(*next.fins_ordered_rad)});
    const auto is_old = [&](const Order& order) {
      return 1e-9 * static_cast<double>(time_ns - order.time_ns) > options_.history_s;
    };
    while (is_old(orders_.front())) orders_.pop_front();
  }
  Controls held{next.fins_rad, actuators_.shaft_rps};
  if (options_.influencer != nullptr) {
    Vector3 fins_rad = array_of(next.fins_rad);
    options_.influencer->link_fins(time_s + kStep_s, kStep_s, fins_rad);
    held.fins_rad = {fins_rad[0], fins_rad[1], fins_rad[2]};
  }
  const Eigen::Vector3d linked_rad = held.fins_rad;
  if (!helm_->holds_over_steps()) {
    held.fins_rad = (linked_rad_.value_or(linked_rad) + linked_rad) / 2;
    held.shaft_rps = (actuators_.shaft_rps + next.shaft_rps) / 2;
  }
  linked_rad_ = linked_rad;
  const LayoutVehicle::Step step = vehicle_.step(body_, held.values(), kStep_s, influences);
  states_.push(state_of(step.acceleration, influences));
  body_ = step.body;
  actuators_ = next;
  check_stable(body_, time_s + kStep_s);
  if (!ended_s_ && helm_->finished()) ended_s_ = static_cast<double>(states_.steps()) * kStep_s;
}

State SimulatedMotion::state_of(const Vector6& acceleration, const Influences& influences) const {
  State state;
  state.position_m = array_of(body_.position_m);
  state.euler_rad = array_of(body_.euler_rad);
  state.velocity_body_m_s = array_of(body_.velocity.head<3>());
  state.rate_rad_s = array_of(body_.velocity.tail<3>());
  state.specific_force_m_s2 =
      specific_force(state.euler_rad, state.velocity_body_m_s, state.rate_rad_s, array_of(acceleration.head<3>()));
  state.rpm_commanded = 60 * actuators_.shaft_commanded_rps;
  state.rpm = 60 * actuators_.shaft_rps;
  state.fins_rad = array_of(actuators_.fins_rad);
  state.motor_current_A = current_A(propeller_, actuators_.shaft_rps);
  state.current_m_s = influences.current_m_s;
  state.water_temperature_C = water_temperature_C(state.position_m[2]);
  return state;
}

}  // namespace navcal::sim
