// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/effects.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace navcal::reference {
namespace {

template <class Names>
std::string listed(const Names& names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

std::string known_effects() {
  std::vector<std::string_view> names;
  for (const auto kinds : {library_effects(), foreign_effects()}) {
    for (const EffectKind& kind : kinds) names.push_back(kind.name);
  }
  return listed(names);
}

double size_of(const std::vector<double>& group, bool symmetric) {
  double sum = 0;
  for (std::size_t i = 0; i < group.size(); ++i) sum += group[i] * group[i] * (symmetric && i >= 3 ? 2 : 1);
  return std::sqrt(sum);
}

}  // namespace

const EffectKind* find_effect(std::string_view name) {
  for (const auto kinds : {library_effects(), foreign_effects()}) {
    for (const EffectKind& kind : kinds) {
      if (kind.name == name) return &kind;
    }
  }
  return nullptr;
}

void add(const Effect& effect, ParameterDeviations& deviations) {
  const EffectKind* const kind = find_effect(effect.name);
  if (kind == nullptr)
    throw std::invalid_argument("no effect is called \"" + effect.name + "\"; known are " + known_effects());
  for (const auto& [key, value] : effect.parameters) {
    const auto at = std::ranges::find(kind->parameters, key);
    if (at == kind->parameters.end())
      throw std::invalid_argument(effect.name + " has no parameter \"" + key + "\"; it has " +
                                  listed(kind->parameters));
    if (!std::isfinite(value)) throw std::invalid_argument(effect.name + ": " + key + " is not a finite number");
    if (kind->size.sign == Sign::not_negative && value < 0)
      throw std::invalid_argument(effect.name + ": " + key + " cannot be negative");
    kind->field(deviations)[at - kind->parameters.begin()] += kind->size.si * value;
  }
}

Effect drawn(const EffectKind& kind, double strength, Rng& dice) {
  Effect effect{std::string(kind.name), {}};
  const bool positive = kind.size.sign != Sign::either;
  for (std::size_t first = 0; first < kind.parameters.size(); first += kind.size.group) {
    std::vector<double> direction(kind.size.group);
    for (std::size_t i = 0; i < kind.size.group; ++i) {
      // A symmetric matrix has its off-diagonal elements twice: all directions are alike in its own norm.
      direction[i] = dice.normal(kind.size.symmetric && i >= 3 ? std::sqrt(0.5) : 1);
      if (positive) direction[i] = std::abs(direction[i]);
    }
    const double scale =
        (positive ? std::abs(strength) : strength) * kind.size.typical / size_of(direction, kind.size.symmetric);
    for (std::size_t i = 0; i < kind.size.group; ++i)
      effect.parameters.emplace(kind.parameters[first + i], scale * direction[i]);
  }
  return effect;
}

void apply_tolerance(double fraction, ParameterDeviations& deviations, Rng& dice) {
  for (const EffectKind& kind : library_effects()) {
    for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
      const double deviate = dice.normal(fraction * kind.size.typical * kind.size.si);
      kind.field(deviations)[i] += kind.size.sign == Sign::not_negative ? std::abs(deviate) : deviate;
    }
  }
}

void apply_tolerance(double fraction, Hull& hull, Rng& dice) {
  for (double* const number :
       {&hull.roll_inertia_factor, &hull.pitch_inertia_factor, &hull.roll_added_inertia, &hull.axial_drag,
        &hull.crossflow_drag, &hull.lift_slope_per_rad, &hull.lift_station_m, &hull.gravity_centre_below_m,
        &hull.fin_lift_slope_per_rad, &hull.fin_induced_drag, &hull.fin_time_s, &hull.thrust_at_rest,
        &hull.thrust_per_advance, &hull.torque_coefficient, &hull.shaft_time_s, &hull.roll_damping_ratio,
        &hull.pitch_damping_ratio, &hull.yaw_damping_per_s}) {
    *number *= 1 + dice.normal(fraction);
  }
}

}  // namespace navcal::reference
