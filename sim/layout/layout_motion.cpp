// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/layout_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/gravity.h"
#include "sim/layout/pulses.h"
#include "sim/rotation.h"

namespace navcal::sim {
namespace {

Vector3 components_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

double height_of(const config::Layout& layout) {
  if (layout.body.size_m[2] > 0) return layout.body.size_m[2];
  return std::cbrt(layout.body.buoyancy_N / (layout.water_density_kg_m3 * base::kGravity_m_s2));
}

State layout_state(const Body& body, const Vector6& acceleration, const Influences& influences) {
  State state;
  state.position_m = components_of(body.position_m);
  state.euler_rad = components_of(body.euler_rad);
  state.velocity_body_m_s = components_of(body.velocity.head<3>());
  state.rate_rad_s = components_of(body.velocity.tail<3>());
  state.specific_force_m_s2 = specific_force(state.euler_rad, state.velocity_body_m_s, state.rate_rad_s,
                                             components_of(acceleration.head<3>()));
  state.current_m_s = influences.current_m_s;
  state.water_temperature_C = water_temperature_C(state.position_m[2]);
  return state;
}

}  // namespace

LayoutMotion::LayoutMotion(config::Layout layout, std::unique_ptr<LayoutHelm> helm, const MotionOptions& options)
    : nominal_(std::move(layout)), options_(options), height_m_(height_of(nominal_)), vehicle_(nominal_),
      helm_(std::move(helm)), body_(helm_->start()), positions_(ActuatorValues::neutral(nominal_)),
      states_(options.history_s) {
  check_stable(body_, 0);
}

State LayoutMotion::at(std::int64_t t_ns) const {
  const std::int64_t elapsed_ns = t_ns - options_.start_ns;
  while (states_.steps() < StepHistory::steps_for(elapsed_ns)) take_step();
  return states_.at(elapsed_ns);
}

void LayoutMotion::take_outputs(std::int64_t t_ns, std::vector<OutputOrder>& out) const {
  (void)at(t_ns);
  for (; !outputs_.empty() && outputs_.front().time_ns <= t_ns; outputs_.pop_front())
    out.push_back(std::move(outputs_.front()));
}

double LayoutMotion::duration_s() const {
  while (!ended_s_) take_step();
  return *ended_s_;
}

void LayoutMotion::change_layout(double time_s) const {
  if (options_.influencer == nullptr || time_s < next_change_s_) return;
  config::Layout layout = nominal_;
  options_.influencer->change_layout(time_s, layout);
  if (layout != vehicle_.layout()) vehicle_ = LayoutVehicle(std::move(layout));
  next_change_s_ = options_.influencer->next_layout_change_s(time_s);
}

void LayoutMotion::take_step() const {
  const std::int64_t elapsed_ns = states_.steps() * kMotionStep_ns;
  const double time_s = static_cast<double>(states_.steps()) * kMotionStep_s;
  change_layout(time_s);
  Influences influences;
  if (options_.influencer != nullptr) options_.influencer->influence(time_s, influences);
  const std::vector<double>& pulses_us = helm_->next(time_s, kMotionStep_s, body_);
  if (elapsed_ns % kOutputs_ns == 0) {
    const std::int64_t time_ns = options_.start_ns + elapsed_ns;
    outputs_.push_back({time_ns, pulses_us});
    while (1e-9 * static_cast<double>(time_ns - outputs_.front().time_ns) > options_.history_s)
      outputs_.pop_front();
  }
  const ActuatorValues next =
      follow(vehicle_.layout(), positions_, commands_of(nominal_, pulses_us), kMotionStep_s);
  LayoutVehicle::Held held = vehicle_.hold(mean_of(positions_, next), influences);
  const double emerged = std::clamp(0.5 - body_.position_m.z() / height_m_, 0.0, 1.0);
  held.restoring.net_weight_N += emerged * vehicle_.layout().body.buoyancy_N;
  const LayoutVehicle::Step step = vehicle_.held_step(body_, held, kMotionStep_s);
  states_.push(layout_state(body_, step.acceleration, influences));
  body_ = step.body;
  positions_ = next;
  check_stable(body_, time_s + kMotionStep_s);
  if (!ended_s_ && helm_->finished()) ended_s_ = static_cast<double>(states_.steps()) * kMotionStep_s;
}

}  // namespace navcal::sim
