// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/stepped_motion.h"

#include "sim/rotation.h"

namespace navcal::sim {

SteppedMotion::SteppedMotion(const MotionOptions& options, const Body& start) : options_(options), body_(start) {
  check_stable(body_, 0);
}

State SteppedMotion::at(std::int64_t t_ns) const {
  const std::int64_t elapsed_ns = std::max<std::int64_t>(0, t_ns - options_.start_ns);
  const std::int64_t step = elapsed_ns / kMotionStep_ns;
  while (steps_ < step + 2) take_step();
  const std::int64_t oldest = steps_ - static_cast<std::int64_t>(states_.size());
  if (step < oldest) return states_.front();
  const auto index = static_cast<std::size_t>(step - oldest);
  const double part =
      static_cast<double>(elapsed_ns - step * kMotionStep_ns) / static_cast<double>(kMotionStep_ns);
  return between(states_[index], states_[index + 1], part);
}

double SteppedMotion::duration_s() const {
  while (!ended_s_) take_step();
  return *ended_s_;
}

void SteppedMotion::end_step(const State& begin, const Body& end, bool orders_finished) const {
  const double end_s = time_s() + kMotionStep_s;
  states_.push_back(begin);
  ++steps_;
  if (static_cast<double>(states_.size()) * kMotionStep_s > options_.history_s && states_.size() > 2)
    states_.pop_front();
  body_ = end;
  check_stable(body_, end_s);
  if (!ended_s_ && orders_finished) ended_s_ = time_s();
}

Influences SteppedMotion::influences() const {
  Influences influences;
  if (options_.influencer != nullptr) options_.influencer->influence(time_s(), influences);
  return influences;
}

void set_motion(State& state, const Body& body, const Vector6& acceleration) {
  state.position_m = array_of(body.position_m);
  state.euler_rad = array_of(body.euler_rad);
  state.velocity_body_m_s = array_of(body.velocity.head<3>());
  state.rate_rad_s = array_of(body.velocity.tail<3>());
  state.specific_force_m_s2 =
      specific_force(state.euler_rad, state.velocity_body_m_s, state.rate_rad_s, array_of(acceleration.head<3>()));
}

State SteppedMotion::state_of(const Vector6& acceleration, const Influences& influences) const {
  State state;
  set_motion(state, body_, acceleration);
  state.current_m_s = influences.current_m_s;
  state.water_temperature_C = water_temperature_C(state.position_m[2]);
  return state;
}

}  // namespace navcal::sim
