// SPDX-License-Identifier: Apache-2.0
#include "validation/confounded_effects.h"

#include <algorithm>
#include <array>
#include <map>

#include "sim/effects/effect_table.h"
#include "validation/reference/effects.h"

namespace navcal::validation {
namespace {

using reference::Trace;

/// Names of the channels that an enumerator of reference::Trace stands for, and the sources of which it is an
/// error, by the equations. A lag of the field or a turned magnetometer is an error of both field and heading.
/// What acts on the whole inertial card is one of each of its instruments.
struct Traced {
  std::vector<std::string_view> channels, sources;
};

const Traced& traced(Trace trace) {
  static const std::map<Trace, Traced> kAll{
      {Trace::field, {{"compass.field", "compass.heading"}, {"compass.field"}}},
      {Trace::heading,
       {{"compass.heading", "compass.field", "gps.velocity", "gps.position"},
        {"compass.heading", "compass.field"}}},
      {Trace::tilt,
       {{"compass.tilt", "compass.heading", "compass.field", "imu.accel", "imu.gyro"}, {"compass.tilt"}}},
      {Trace::roll,
       {{"compass.tilt", "compass.heading", "compass.field", "imu.accel", "imu.gyro"}, {"vehicle.moments"}}},
      {Trace::rates,
       {{"imu.gyro", "compass.heading", "compass.tilt", "compass.field", "vehicle.yaw_rate", "vehicle.pitch_rate"},
        {"imu.gyro"}}},
      {Trace::force,
       {{"imu.accel", "compass.tilt", "vehicle.speed", "gps.velocity", "gps.position"}, {"imu.accel"}}},
      {Trace::card,
       {{"imu.gyro", "imu.accel", "imu.depth", "compass.heading", "compass.tilt", "compass.field",
         "vehicle.yaw_rate", "vehicle.pitch_rate", "vehicle.depth_rate"},
        {"imu.gyro", "imu.accel", "imu.depth"}}},
      {Trace::depth, {{"imu.depth", "vehicle.depth_rate"}, {"imu.depth"}}},
      {Trace::fixes, {{"gps.position", "gps.velocity"}, {"gps"}}},
      {Trace::drift, {{"gps.position", "gps.velocity", "vehicle.speed"}, {"water.current"}}},
      {Trace::thrust,
       {{"vehicle.speed", "gps.velocity", "gps.position", "imu.accel", "imu.gyro", "vehicle.pitch_rate",
         "vehicle.depth_rate", "vehicle.yaw_rate"},
        {"vehicle.thrust"}}},
      {Trace::fins,
       {{"vehicle.yaw_rate", "vehicle.pitch_rate", "imu.gyro", "compass.heading", "vehicle.depth_rate",
         "imu.accel", "compass.tilt"},
        {"vehicle.moments"}}},
      {Trace::rise, {{"vehicle.depth_rate", "imu.depth", "vehicle.pitch_rate"}, {"vehicle.heave"}}},
      {Trace::supply,
       {{"vehicle.speed", "imu.accel", "imu.gyro", "imu.depth", "gps.velocity", "gps.position"},
        {"vehicle.thrust", "imu.gyro", "imu.accel", "imu.depth"}}},
      {Trace::waves,
       {{"vehicle.yaw_rate", "imu.accel", "imu.gyro", "compass.tilt", "gps.velocity"},
        {"vehicle.moments", "vehicle.heave"}}},
  };
  return kAll.at(trace);
}

/// Families of the quantities in a foreign effect's equation (docs/trial.md).
std::span<const std::string_view> families_of(std::string_view foreign) {
  using Families = std::vector<std::string_view>;
  static const std::map<std::string_view, Families> kAll{
      {"crossflow_depth", {"depth"}},
      {"torque_leak", {"command", "speed", "current"}},
      {"tidal_current", {"time"}},
      {"battery_sag", {"time", "current"}},
      {"fin_stall", {"command", "rate"}},
      {"fouling", {"time"}},
      {"surface_waves", {"depth", "time"}},
      {"heading_lag", {"rate"}},
      {"magnetometer_saturation", {"heading"}},
      {"gyro_thermal_twist", {"temperature", "rate"}},
      {"gyro_popcorn", {"time"}},
      {"depth_hysteresis", {"depth", "lag"}},
      {"gps_multipath", {"heading"}},
  };
  return kAll.at(foreign);
}

std::vector<TrialSignature> all_signatures() {
  std::vector<TrialSignature> all;
  for (const reference::EffectKind& kind : reference::library_effects()) {
    const Traced& of = traced(kind.trace);
    all.push_back({kind.name, {}, of.channels, of.sources});
    if (const auto effect = sim::make_effect(kind.name)) {
      const auto confounders = effect->description().confounders;
      all.back().confounders.assign(confounders.begin(), confounders.end());
    }
  }
  for (const reference::EffectKind& kind : reference::foreign_effects()) {
    const Traced& of = traced(kind.trace);
    all.push_back({kind.name, {}, of.channels, of.sources, families_of(kind.name)});
  }
  return all;
}

/// Effects of a vehicle with thrusters that leave nearly the same traces.
bool is_pair(std::string_view a, std::string_view b) {
  constexpr std::array<ConfoundedEffects, 10> kPairs{{{"weight", "buoyancy"},
                                                      {"weight", "gravity_shift"},
                                                      {"buoyancy", "gravity_shift"},
                                                      {"buoyancy_shift", "gravity_shift"},
                                                      {"hard_iron", "compass_deviation"},
                                                      {"gravity_shift", "tilt_offset"},
                                                      {"damping", "thrust_scale"},
                                                      {"damping", "water_current"},
                                                      {"added_mass", "weight"},
                                                      {"thruster_offset", "buoyancy"}}};
  return std::any_of(kPairs.begin(), kPairs.end(), [&](const ConfoundedEffects& pair) {
    return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
  });
}

/// "thrust_scale" and "thruster.2" of "thrust_scale of thruster.2".
std::array<std::string_view, 2> parts_of(std::string_view full_name) {
  constexpr std::string_view kOf = " of ";
  const std::size_t at = full_name.find(kOf);
  if (at == std::string_view::npos) return {full_name, {}};
  return {full_name.substr(0, at), full_name.substr(at + kOf.size())};
}

bool belongs(const TrialEffect& effect, std::string_view of) {
  return of == effect.of || (!of.empty() && of == effect.of_name);
}

}  // namespace

bool is_same(const TrialEffect& effect, std::string_view full_name) {
  const auto [name, of] = parts_of(full_name);
  return name == effect.name && belongs(effect, of);
}

bool is_confounded(const TrialEffect& effect, std::string_view full_name) {
  const auto [name, of] = parts_of(full_name);
  if (name == effect.name) return belongs(effect, of);
  if ((!effect.of.empty() && belongs(effect, of)) || is_pair(effect.name, name)) return true;
  const TrialSignature* const signature = signature_of(effect.name);
  return signature != nullptr && std::find(signature->confounders.begin(), signature->confounders.end(), name) !=
                                     signature->confounders.end();
}

std::span<const TrialSignature> trial_signatures() {
  static const std::vector<TrialSignature> all = all_signatures();
  return all;
}

const TrialSignature* signature_of(std::string_view effect) {
  const auto all = trial_signatures();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.effect == effect; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<ConfoundedEffects> confounded_pairs() {
  std::vector<ConfoundedEffects> pairs;
  for (const TrialSignature& signature : trial_signatures()) {
    for (const std::string_view other : signature.confounders) {
      const bool known = std::any_of(pairs.begin(), pairs.end(), [&](const ConfoundedEffects& pair) {
        return pair.first == other && pair.second == signature.effect;
      });
      if (!known) pairs.push_back({signature.effect, other});
    }
  }
  return pairs;
}

}  // namespace navcal::validation
