// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <memory>
#include <string_view>
#include <vector>

#include "sim/effects/effect_table.h"

namespace navcal::sim::testing {

/// An effect with these parameters, the rest zero.
inline std::unique_ptr<Effect> effect_with(std::string_view name, std::initializer_list<double> values) {
  auto effect = make_effect(name);
  std::vector<double> all(values);
  all.resize(effect->description().parameters.size());
  effect->set_parameters(all);
  return effect;
}

/// A simple state, different in every component.
inline State some_state() {
  State state;
  state.position_m = {100, -50, 2};
  state.euler_rad = {0.1, -0.2, 0.7};
  state.velocity_body_m_s = {1.1, 0.05, -0.02};
  state.rate_rad_s = {0.02, -0.03, 0.4};
  state.specific_force_m_s2 = {2.1, 0.6, -9.5};
  state.motor_current_A = 1.4;
  return state;
}

}  // namespace navcal::sim::testing
