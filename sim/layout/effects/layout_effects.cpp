// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/effects/layout_effects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "autopilot/controllability.h"
#include "sim/layout/effects/effect_changes.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 1> kLayoutScaleOf{{{"scale", 0.08, -1, 4}}};
constexpr std::array<EffectParameter, 1> kLayoutGain{{{"scale", 0.08, -2, 4}}};
constexpr std::array<EffectParameter, 1> kLayoutForm{{{"scale", 0.2, -0.9, 10}}};
constexpr std::array<EffectParameter, 1> kLayoutPercent{{{"percent", 3, -100, 100}}};
constexpr std::array<EffectParameter, 1> kLayoutBand{{{"percent", 3, 0, 100}}};
constexpr std::array<EffectParameter, 1> kLayoutTau{{{"tau_s", 0.2, 0, 30}}};
constexpr std::array<EffectParameter, 1> kLayoutAngle{{{"angle_deg", 1, -45, 45}}};
constexpr std::array<EffectParameter, 1> kLayoutAngleBand{{{"angle_deg", 1, 0, 45}}};
constexpr std::array<EffectParameter, 1> kLayoutForce{{{"force_N", 0.0077}}};
constexpr std::array<EffectParameter, 1> kLayoutBallastForce{{{"force_N", 0.001}}};
constexpr std::array<EffectParameter, 1> kLayoutWay{{{"way_m", 0.01}}};
constexpr std::array<EffectParameter, 1> kLayoutShare{{{"share", 1, 0, 1}}};
constexpr std::array<EffectParameter, 1> kLayoutMass{{{"mass_kg", 0.01}}};
constexpr std::array<EffectParameter, 3> kLayoutPlaceShift{{{"x_m", 0.01}, {"y_m", 0.01}, {"z_m", 0.01}}};
constexpr std::array<EffectParameter, 1> kLayoutPerSecond{{{"per_s", 0.3, -5, 20}}};

using enum LayoutPart;

constexpr std::array kLayoutEffects{
    LayoutEffectDescription{"actuator_dead", "command away from neutral *= 1 - k", kLayoutShare, actuator,
                            LayoutScale::one, "command each actuator alone"},
    LayoutEffectDescription{"actuator_reversed", "command away from neutral *= 1 - 2 k", kLayoutShare, actuator,
                            LayoutScale::one, "command each actuator alone"},
    LayoutEffectDescription{"added_mass", "M_A *= 1 + k in this degree of freedom", kLayoutForm, freedom,
                            LayoutScale::one, "steps of the force"},
    LayoutEffectDescription{"ballast_offset", "ballast += F", kLayoutBallastForce, ballast, LayoutScale::weight_N,
                            "hover or glide"},
    LayoutEffectDescription{"ballast_scale", "ballast *= 1 + k", kLayoutGain, ballast, LayoutScale::one,
                            "glide down and up"},
    LayoutEffectDescription{"buoyancy", "B += F", kLayoutForce, vehicle, LayoutScale::weight_N,
                            "hover or glide with thrusters off"},
    LayoutEffectDescription{"buoyancy_shift", "r_B += s", kLayoutPlaceShift, vehicle, LayoutScale::length_m,
                            "lie still, then roll and pitch", 3},
    LayoutEffectDescription{"damping", "forces of the hull *= 1 + k in this degree of freedom", kLayoutForm,
                            freedom, LayoutScale::one, "steady motion at several speeds"},
    LayoutEffectDescription{"fin_dead_band", "angles nearer to zero than b are zero", kLayoutAngleBand, surface,
                            LayoutScale::one, "small doublets"},
    LayoutEffectDescription{"fin_gain", "d *= 1 + k", kLayoutGain, surface, LayoutScale::one,
                            "doublets at several amplitudes"},
    LayoutEffectDescription{"fin_lag", "lag += tau", kLayoutTau, surface, LayoutScale::one, "fast doublets"},
    LayoutEffectDescription{"fin_offset", "d += o", kLayoutAngle, surface, LayoutScale::one, "straight legs"},
    LayoutEffectDescription{"gravity_shift", "r_G += s", kLayoutPlaceShift, vehicle, LayoutScale::length_m,
                            "lie still, then roll and pitch", 3},
    LayoutEffectDescription{"mass_offset", "place of the mass += s", kLayoutWay, moving_mass,
                            LayoutScale::length_m, "glide at several angles"},
    LayoutEffectDescription{"mass_scale", "place of the mass *= 1 + k", kLayoutGain, moving_mass, LayoutScale::one,
                            "glide at several angles"},
    LayoutEffectDescription{"thrust_scale", "thrust *= 1 + k", kLayoutScaleOf, thruster, LayoutScale::one,
                            "speed steps on reciprocal legs"},
    LayoutEffectDescription{"thruster_dead_band", "dead band += b, in % of the command's range", kLayoutBand,
                            thruster, LayoutScale::one, "small commands about neutral"},
    LayoutEffectDescription{"thruster_lag", "lag += tau", kLayoutTau, thruster, LayoutScale::one,
                            "fast steps of the command"},
    LayoutEffectDescription{"thruster_offset", "command += o, in % of its range", kLayoutPercent, thruster,
                            LayoutScale::one, "hover, and steps up and down"},
    LayoutEffectDescription{"weight", "m += dm, at the centre of gravity", kLayoutMass, vehicle,
                            LayoutScale::mass_kg, "hover or glide with thrusters off"},
    LayoutEffectDescription{"yaw_damping", "N -= k M66 r", kLayoutPerSecond, vehicle, LayoutScale::one,
                            "turns at several rates"},
};

/// An actuator by kind and number from 0.
struct Owner {
  LayoutPart part = vehicle;
  std::size_t index = 0;
};

std::string_view word_of(LayoutPart part) {
  switch (part) {
    case thruster: return "thruster";
    case surface: return "surface";
    case ballast: return "ballast";
    case moving_mass: return "moving_mass";
    default: return "";
  }
}

template <class Visit>
void each_kind(const config::Layout& layout, LayoutPart part, Visit visit) {
  if (part == thruster || part == actuator) visit(thruster, layout.thrusters);
  if (part == surface || part == actuator) visit(surface, layout.surfaces);
  if (part == ballast || part == actuator) visit(ballast, layout.ballasts);
  if (part == moving_mass || part == actuator) visit(moving_mass, layout.moving_masses);
}

/// What `of` names; all parts of the kind when it is empty.
std::vector<Owner> named_owners(const config::Layout& layout, LayoutPart part, std::string_view of) {
  std::vector<Owner> owners;
  if (part == vehicle) return of.empty() ? std::vector<Owner>{{}} : owners;
  if (part == freedom) {
    for (std::size_t i = 0; i < 6; ++i) {
      if (of.empty() || of == autopilot::kDegreesOfFreedom[i]) owners.push_back({freedom, i});
    }
    return owners;
  }
  each_kind(layout, part, [&](LayoutPart kind, const auto& actuators) {
    for (std::size_t i = 0; i < actuators.size(); ++i) {
      if (of.empty() || of == fmt::format("{}.{}", word_of(kind), i + 1) || of == actuators[i].name)
        owners.push_back({kind, i});
    }
  });
  return owners;
}

config::LayoutHeard& heard_of(config::Layout& layout, const Owner& owner) {
  switch (owner.part) {
    case surface: return layout.surfaces[owner.index].heard;
    case ballast: return layout.ballasts[owner.index].heard;
    case moving_mass: return layout.moving_masses[owner.index].heard;
    default: return layout.thrusters[owner.index].heard;
  }
}

using Change = void (*)(config::Layout&, const Owner&, change::Values);

/// The change of a name; kLayoutEffects without one is a mistake that a test finds.
Change change_named(std::string_view name) {
  struct Named {
    std::string_view name;
    Change change;
  };
  using change::Values;
  using config::Layout;
  static constexpr std::array<Named, kLayoutEffects.size()> kChanges{{
      {"actuator_dead", [](Layout& l, const Owner& o, Values v) { change::dead(heard_of(l, o), v); }},
      {"actuator_reversed", [](Layout& l, const Owner& o, Values v) { change::reversed(heard_of(l, o), v); }},
      {"added_mass", [](Layout& l, const Owner& o, Values v) { change::added_mass(l, o.index, v); }},
      {"ballast_offset",
       [](Layout& l, const Owner& o, Values v) { change::ballast_offset(l.ballasts[o.index], v); }},
      {"ballast_scale",
       [](Layout& l, const Owner& o, Values v) { change::ballast_scale(l.ballasts[o.index], v); }},
      {"buoyancy", [](Layout& l, const Owner&, Values v) { change::buoyancy(l, v); }},
      {"buoyancy_shift", [](Layout& l, const Owner&, Values v) { change::buoyancy_shift(l, v); }},
      {"damping", [](Layout& l, const Owner& o, Values v) { change::damping(l, o.index, v); }},
      {"fin_dead_band",
       [](Layout& l, const Owner& o, Values v) { change::fin_dead_band(l.surfaces[o.index], v); }},
      {"fin_gain", [](Layout& l, const Owner& o, Values v) { change::fin_gain(l.surfaces[o.index], v); }},
      {"fin_lag", [](Layout& l, const Owner& o, Values v) { change::fin_lag(l.surfaces[o.index], v); }},
      {"fin_offset", [](Layout& l, const Owner& o, Values v) { change::fin_offset(l.surfaces[o.index], v); }},
      {"gravity_shift", [](Layout& l, const Owner&, Values v) { change::gravity_shift(l, v); }},
      {"mass_offset",
       [](Layout& l, const Owner& o, Values v) { change::mass_offset(l.moving_masses[o.index], v); }},
      {"mass_scale", [](Layout& l, const Owner& o, Values v) { change::mass_scale(l.moving_masses[o.index], v); }},
      {"thrust_scale", [](Layout& l, const Owner& o, Values v) { change::thrust_scale(l.thrusters[o.index], v); }},
      {"thruster_dead_band",
       [](Layout& l, const Owner& o, Values v) { change::thruster_dead_band(l.thrusters[o.index], v); }},
      {"thruster_lag", [](Layout& l, const Owner& o, Values v) { change::thruster_lag(l.thrusters[o.index], v); }},
      {"thruster_offset",
       [](Layout& l, const Owner& o, Values v) { change::thruster_offset(l.thrusters[o.index], v); }},
      {"weight", [](Layout& l, const Owner&, Values v) { change::weight(l, v); }},
      {"yaw_damping", [](Layout& l, const Owner&, Values v) { change::yaw_damping(l, v); }},
  }};
  const auto found =
      std::find_if(kChanges.begin(), kChanges.end(), [&](const Named& named) { return named.name == name; });
  return found == kChanges.end() ? nullptr : found->change;
}

double scale_value(const config::Layout& layout, LayoutScale scale) {
  switch (scale) {
    case LayoutScale::mass_kg: return layout.body.mass_kg;
    case LayoutScale::weight_N: return layout.weight_N();
    case LayoutScale::length_m:
      return std::cbrt(layout.body.buoyancy_N / (layout.water_density_kg_m3 * base::kGravity_m_s2));
    case LayoutScale::one: break;
  }
  return 1;
}

std::string_view scale_words(LayoutScale scale) {
  switch (scale) {
    case LayoutScale::mass_kg: return " of the mass";
    case LayoutScale::weight_N: return " of the weight";
    case LayoutScale::length_m: return " of the cube root of the volume";
    case LayoutScale::one: break;
  }
  return "";
}

std::string_view part_words(LayoutPart part) {
  switch (part) {
    case vehicle: return "";
    case actuator: return "thruster, surface, ballast, moving_mass";
    case freedom: return "surge, sway, heave, roll, pitch, yaw";
    default: return word_of(part);
  }
}

}  // namespace

std::span<const LayoutEffectDescription> layout_effects() { return kLayoutEffects; }

const LayoutEffectDescription* find_layout_effect(std::string_view name) {
  const auto found = std::find_if(kLayoutEffects.begin(), kLayoutEffects.end(),
                                  [&](const LayoutEffectDescription& about) { return about.name == name; });
  return found == kLayoutEffects.end() ? nullptr : &*found;
}

std::vector<std::string> owners_of(const config::Layout& layout, const LayoutEffectDescription& about) {
  std::vector<std::string> names;
  if (about.part == vehicle) return names;
  for (const Owner& owner : named_owners(layout, about.part, {}))
    names.push_back(about.part == freedom ? std::string(autopilot::kDegreesOfFreedom[owner.index])
                                          : fmt::format("{}.{}", word_of(owner.part), owner.index + 1));
  return names;
}

std::optional<std::string> owner_refusal(const config::Layout& layout, const LayoutEffectDescription& about,
                                         std::string_view of) {
  if (!named_owners(layout, about.part, of).empty()) return std::nullopt;
  if (about.part == vehicle) return fmt::format("{} belongs to the whole vehicle, not to {}", about.name, of);
  const std::vector<std::string> owners = owners_of(layout, about);
  if (owners.empty()) return fmt::format("the layout has no {}", part_words(about.part));
  return fmt::format("there is no {}; {} belongs to one of: {}", of, about.name, fmt::join(owners, ", "));
}

std::vector<EffectParameter> parameters_for(const config::Layout& layout, const LayoutEffectDescription& about) {
  std::vector<EffectParameter> parameters(about.parameters.begin(), about.parameters.end());
  for (EffectParameter& parameter : parameters) parameter.typical *= scale_value(layout, about.scale);
  return parameters;
}

config::Layout changed_layout(config::Layout layout, const LayoutEffect& effect) {
  const Change change = change_named(effect.about->name);
  for (const Owner& owner : named_owners(layout, effect.about->part, effect.of))
    change(layout, owner, effect.values);
  return layout;
}

std::string layout_effects_text() {
  std::string text = "| effect | of | equation | parameters | typical |\n|---|---|---|---|---|\n";
  for (const LayoutEffectDescription& about : kLayoutEffects) {
    std::vector<std::string_view> names;
    for (const EffectParameter& parameter : about.parameters) names.push_back(parameter.name);
    text += fmt::format("| {} | {} | {} | {} | {:g}{}{} |\n", about.name, part_words(about.part), about.equation,
                        fmt::join(names, " "), about.parameters.front().typical, scale_words(about.scale),
                        about.vector > 1 ? ", as a vector" : "");
  }
  return text;
}

}  // namespace navcal::sim
