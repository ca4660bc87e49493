// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "validation/reference/effects.h"
#include "validation/reference/thrusters/allocator.h"

namespace navcal::reference::thrusters {
namespace {

constexpr std::array<std::string_view, kAxes> kAxisNames{"surge", "sway", "heave", "roll", "pitch", "yaw"};

/// Of the instruments' effects those that need no motor current: these vehicles report none.
constexpr std::array<std::string_view, 26> kInstrumentEffects{
    "hard_iron",           "soft_iron",       "compass_misalignment", "declination",
    "magnetic_hysteresis", "mag_temperature", "compass_lag",          "tilt_slosh",
    "tilt_offset",         "gyro_scale",      "gyro_temperature",     "gyro_drift",
    "gyro_g_sensitivity",  "gyro_cross_axis", "gyro_nonlinearity",    "accel_bias",
    "accel_scale",         "imu_latency",     "depth_scale",          "depth_temperature",
    "gps_latency",         "gps_lever_arm",   "water_current",        "magnetometer_saturation",
    "gyro_popcorn",        "depth_hysteresis"};

std::vector<CraftEffectKind> all_effects() {
  std::vector<CraftEffectKind> kinds{
      {"thrust_scale", Scope::thruster, true, {"scale"}, false},
      {"thruster_offset", Scope::thruster, true, {"half_range"}, false},
      {"thruster_lag", Scope::thruster, true, {"tau_s"}},
      {"thruster_dead_band", Scope::thruster, true, {"half_range"}},
      {"actuator_reversed", Scope::thruster, true, {}},
      {"actuator_dead", Scope::thruster, true, {}},
      {"damping", Scope::axis, true, {"scale"}, false},
      {"added_mass", Scope::axis, true, {"scale"}, false},
      {"weight", Scope::vehicle, true, {"mass_kg"}, false},
      {"buoyancy", Scope::vehicle, true, {"force_N"}, false},
      {"gravity_shift", Scope::vehicle, true, {"x_m", "y_m", "z_m"}, false},
      {"battery_sag", Scope::vehicle, false, {"share"}},
      {"tether", Scope::vehicle, false, {"kg_m"}},
      {"sway_jet", Scope::vehicle, false, {"share"}},
      {"swell", Scope::vehicle, false, {"amplitude_m"}},
      {"leak", Scope::vehicle, false, {"N_s"}},
      {"propeller_fouling", Scope::thruster, false, {"per_s"}},
  };
  for (const std::string_view name : kInstrumentEffects) {
    const EffectKind* const kind = find_effect(name);
    const auto library = library_effects();
    const bool in_library = kind >= library.data() && kind < library.data() + library.size();
    kinds.push_back({kind->name, Scope::instrument, in_library, kind->parameters});
  }
  return kinds;
}

/// Typical strength of an effect that is no instrument's, in the unit of its parameter.
double typical(std::string_view name, const Plan& plan) {
  if (name == "thrust_scale") return 0.2;
  if (name == "thruster_offset") return 0.05;
  if (name == "thruster_lag") return 0.3;
  if (name == "thruster_dead_band") return 0.06;
  if (name == "damping") return 0.3;
  if (name == "added_mass") return 0.4;
  if (name == "weight") return 0.02 * plan.mass_kg;
  if (name == "buoyancy") return 0.015 * plan.mass_kg * kGravity_m_s2;
  if (name == "gravity_shift")
    return std::max(0.2 * (plan.gravity_centre_m - plan.buoyancy_centre_m).norm(), 5e-4);
  if (name == "battery_sag") return 0.3;
  if (name == "tether") return 0.15 * std::max(plan.quadratic(0, 0) + plan.axial_kg_m, 1.0);
  if (name == "sway_jet") return 0.5;
  if (name == "swell") return 0.1;
  if (name == "leak") return 0.01 * plan.mass_kg * kGravity_m_s2 / 100;
  return 0.004;  // propeller_fouling: a quarter of the force within a minute
}

/// Place in the list of what is named "thruster.3".
std::size_t thruster_of(const CraftEffect& effect, const Plan& plan) {
  constexpr std::string_view kPrefix = "thruster.";
  std::size_t number = 0;
  if (effect.of.starts_with(kPrefix) && effect.of.size() <= kPrefix.size() + 3) {
    for (const char digit : effect.of.substr(kPrefix.size())) {
      if (digit < '0' || digit > '9') throw std::invalid_argument(effect.name + ": no thruster " + effect.of);
      number = 10 * number + static_cast<std::size_t>(digit - '0');
    }
  }
  if (number < 1 || number > plan.thrusters.size())
    throw std::invalid_argument(effect.name + ": the vehicle has no \"" + effect.of + "\"");
  return number - 1;
}

Eigen::Index axis_of(const CraftEffect& effect) {
  const auto* const found = std::ranges::find(kAxisNames, effect.of);
  if (found == kAxisNames.end()) throw std::invalid_argument(effect.name + ": no axis \"" + effect.of + "\"");
  return found - kAxisNames.begin();
}

double* field_of(const CraftEffect& effect, const Plan& plan, CraftDeviations& craft) {
  const std::string& name = effect.name;
  if (name == "damping") return &craft.damping(axis_of(effect));
  if (name == "added_mass") return &craft.added_mass(axis_of(effect));
  if (name == "weight") return &craft.mass_kg;
  if (name == "buoyancy") return &craft.lift_N;
  if (name == "gravity_shift") return craft.gravity_shift_m.data();
  if (name == "battery_sag") return &craft.sag;
  if (name == "tether") return &craft.tether_kg_m;
  if (name == "sway_jet") return &craft.sway_jet;
  if (name == "swell") return &craft.wave_m;
  if (name == "leak") return &craft.leak_N_s;
  RotorDeviations& rotor = craft.rotors[thruster_of(effect, plan)];
  if (name == "thrust_scale") return &rotor.scale;
  if (name == "thruster_offset") return &rotor.offset;
  if (name == "thruster_lag") return &rotor.lag_s;
  if (name == "thruster_dead_band") return &rotor.dead_band;
  if (name == "propeller_fouling") return &rotor.fouling_per_s;
  return nullptr;
}

Eigen::Matrix3d symmetric_factors(double fraction, Rng& dice) {
  Vector3 root;
  for (double& one : root) one = std::sqrt(std::max(1 + dice.normal(fraction), 0.01));
  return root * root.transpose();
}

Matrix6 axis_factors(double fraction, Rng& dice) {
  Vector6 root;
  for (double& one : root) one = std::sqrt(std::max(1 + dice.normal(fraction), 0.01));
  return root * root.transpose();
}

void perturb(PlannedThruster& thruster, double fraction, Rng& dice) {
  const double factor = 1 + dice.normal(fraction);
  for (double& force : thruster.force_N) force *= factor;
  for (double& coefficient : thruster.KT) coefficient *= factor;
  thruster.lag_s *= std::max(1 + dice.normal(2 * fraction), 0.1);
  thruster.torque_arm_m *= 1 + dice.normal(fraction);
  for (double& place : thruster.place_m) place += dice.normal(0.05 * fraction);  // 1 mm at 2 %
  for (double& part : thruster.direction) part += dice.normal(fraction / 4);     // 0.3 degrees at 2 %
  thruster.direction.normalize();
}

}  // namespace

std::span<const CraftEffectKind> craft_effects() {
  static const std::vector<CraftEffectKind> kinds = all_effects();
  return kinds;
}

const CraftEffectKind* find_craft_effect(std::string_view name) {
  for (const CraftEffectKind& kind : craft_effects()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

CraftEffect drawn(const CraftEffectKind& kind, double strength, const Plan& plan, Rng& dice) {
  CraftEffect effect{std::string(kind.name), "", {}};
  if (kind.scope == Scope::instrument) {
    effect.parameters = drawn(*find_effect(kind.name), strength, dice).parameters;
    return effect;
  }
  if (kind.scope == Scope::thruster)
    effect.of = "thruster." + std::to_string(1 + dice.bits() % plan.thrusters.size());
  if (kind.scope == Scope::axis) {
    // An axis that nothing drives tells nothing of its inertia and drag.
    const Allocator allocator(plan);
    std::size_t axis = 0;
    do axis = dice.bits() % kAxes;
    while (!allocator.commands(axis));
    effect.of = kAxisNames[axis];
  }
  std::vector<double> direction(kind.parameters.size());
  double size2 = 0;
  for (double& one : direction) {
    one = dice.normal();
    if (kind.is_positive) one = std::abs(one);
    size2 += one * one;
  }
  for (std::size_t i = 0; i < direction.size(); ++i)
    effect.parameters.emplace(kind.parameters[i],
                              strength * typical(kind.name, plan) * direction[i] / std::sqrt(size2));
  return effect;
}

void add(const CraftEffect& effect, const Plan& plan, Differences& differences) {
  const CraftEffectKind* const kind = find_craft_effect(effect.name);
  if (kind == nullptr)
    throw std::invalid_argument("vehicles with thrusters have no effect \"" + effect.name + '"');
  if (kind->scope == Scope::instrument) {
    reference::add({effect.name, effect.parameters}, differences.instruments);
    return;
  }
  CraftDeviations& craft = differences.craft;
  craft.rotors.resize(plan.thrusters.size());
  if (effect.name == "actuator_reversed") craft.rotors[thruster_of(effect, plan)].reversed = true;
  if (effect.name == "actuator_dead") craft.rotors[thruster_of(effect, plan)].dead = true;
  double* const field = field_of(effect, plan, craft);
  for (const auto& [key, value] : effect.parameters) {
    const auto at = std::ranges::find(kind->parameters, key);
    if (at == kind->parameters.end() || !std::isfinite(value))
      throw std::invalid_argument(effect.name + " has no parameter \"" + key + "\" of this value");
    field[at - kind->parameters.begin()] += value;
  }
}

Plan perturbed(Plan plan, double fraction, Rng& dice) {
  const double trim_N = plan.buoyancy_N - plan.mass_kg * kGravity_m_s2;
  plan.mass_kg *= 1 + dice.normal(fraction / 4);
  // A vehicle is ballasted to its trim, whatever its mass: to 0.05 % of the weight at 2 %.
  plan.buoyancy_N = plan.mass_kg * kGravity_m_s2 * (1 + dice.normal(fraction / 40)) + trim_N;
  plan.inertia_kg_m2 = plan.inertia_kg_m2.cwiseProduct(symmetric_factors(fraction, dice)).eval();
  const double arm_m = (plan.gravity_centre_m - plan.buoyancy_centre_m).norm();
  for (double& place : plan.gravity_centre_m) place += dice.normal(fraction * arm_m);
  plan.added_mass = plan.added_mass.cwiseProduct(axis_factors(2 * fraction, dice)).eval();
  plan.linear = plan.linear.cwiseProduct(axis_factors(2 * fraction, dice)).eval();
  plan.quadratic = plan.quadratic.cwiseProduct(axis_factors(2 * fraction, dice)).eval();
  plan.lift = plan.lift.cwiseProduct(axis_factors(2 * fraction, dice)).eval();
  plan.axial_kg_m *= 1 + dice.normal(2 * fraction);
  plan.crossflow *= 1 + dice.normal(2 * fraction);
  plan.body_lift_kg_m *= 1 + dice.normal(2 * fraction);
  for (PlannedThruster& thruster : plan.thrusters) perturb(thruster, fraction, dice);
  return plan;
}

}  // namespace navcal::reference::thrusters
