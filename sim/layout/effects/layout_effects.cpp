// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/effects/layout_effects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "autopilot/controllability.h"
#include "base/angles.h"
#include "base/enum_name.h"
#include "sim/layout/mass_matrix.h"

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

using config::Layout;
using Owner = LayoutOwner;
using Values = std::span<const double>;
using Row = LayoutEffectDescription;

config::LayoutHeard& heard_of(Layout& layout, const Owner& owner) {
  switch (owner.part) {
    case surface: return layout.surfaces[owner.index].heard;
    case ballast: return layout.ballasts[owner.index].heard;
    case moving_mass: return layout.moving_masses[owner.index].heard;
    default: return layout.thrusters[owner.index].heard;
  }
}

double half_range(const config::LayoutThruster& thruster) {
  return std::max(thruster.high - thruster.neutral(), thruster.neutral() - thruster.low);
}

void shift(config::LayoutVector& place_m, Values by_m) {
  for (std::size_t i = 0; i < 3; ++i) place_m[i] += by_m[i];
}

/// Lags and dead bands end at zero.
void add_to(double& number, double change) { number = std::max(number + change, 0.0); }

void change_thrust_scale(Layout& layout, const Owner& owner, Values values) {
  // The thrust, not the torque. T0 - k sqrt(|T0|) u_a is scaled whole when k grows with the root.
  config::LayoutThruster& thruster = layout.thrusters[owner.index];
  const double factor = 1 + values[0];
  for (double& force : thruster.table_force_N) force *= factor;
  thruster.advance_loss_sqrtN_s_m *= std::sqrt(factor);
  if (factor > 0) thruster.torque_m /= factor;
  for (double& coefficient : thruster.KT) coefficient *= factor;
}

void change_added_mass(Layout& layout, const Owner& owner, Values values) {
  // S M_A S with S = diag(1, .., sqrt(1 + k), .., 1) stays symmetric and positive definite.
  Matrix6 matrix = added_mass(layout);
  const double root = std::sqrt(1 + values[0]);
  const auto i = static_cast<Eigen::Index>(owner.index);
  matrix.row(i) *= root;
  matrix.col(i) *= root;
  layout.added_mass.spheroid.reset();
  layout.added_mass.strips = {};
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(layout.added_mass.matrix_kg.data()) = matrix;
}

void change_yaw_damping(Layout& layout, const Owner&, Values values) {
  const std::vector<double> at_rest(layout.moving_masses.size());
  const double yaw_kg_m2 = rigid_body_mass(layout, at_rest)(5, 5) + added_mass(layout)(5, 5);
  layout.damping.linear[35] += values[0] * yaw_kg_m2;
}

constexpr std::array kLayoutEffects{
    Row{"actuator_dead", "command away from neutral *= 1 - k", kLayoutShare, actuator, LayoutScale::one,
        "command each actuator alone",
        [](Layout& l, const Owner& o, Values v) { heard_of(l, o).scale *= 1 - v[0]; }},
    Row{"actuator_reversed", "command away from neutral *= 1 - 2 k", kLayoutShare, actuator, LayoutScale::one,
        "command each actuator alone",
        [](Layout& l, const Owner& o, Values v) { heard_of(l, o).scale *= 1 - 2 * v[0]; }},
    Row{"added_mass", "M_A *= 1 + k in this degree of freedom", kLayoutForm, freedom, LayoutScale::one,
        "steps of the force", change_added_mass},
    Row{"ballast_offset", "ballast += F", kLayoutBallastForce, ballast, LayoutScale::weight_N, "hover or glide",
        [](Layout& l, const Owner& o, Values v) { l.ballasts[o.index].heard.offset += v[0]; }},
    Row{"ballast_scale", "ballast *= 1 + k", kLayoutGain, ballast, LayoutScale::one, "glide down and up",
        [](Layout& l, const Owner& o, Values v) { l.ballasts[o.index].heard.scale *= 1 + v[0]; }},
    Row{"buoyancy", "B += F", kLayoutForce, vehicle, LayoutScale::weight_N, "hover or glide with thrusters off",
        [](Layout& l, const Owner&, Values v) { l.body.buoyancy_N += v[0]; }},
    Row{"buoyancy_shift", "r_B += s", kLayoutPlaceShift, vehicle, LayoutScale::length_m,
        "lie still, then roll and pitch",
        [](Layout& l, const Owner&, Values v) { shift(l.body.buoyancy_centre_m, v); }, 3},
    Row{"damping", "forces of the hull *= 1 + k in this degree of freedom", kLayoutForm, freedom, LayoutScale::one,
        "steady motion at several speeds",
        [](Layout& l, const Owner& o, Values v) { l.damping.factors[o.index] *= 1 + v[0]; }},
    Row{"fin_dead_band", "angles nearer to zero than b are zero", kLayoutAngleBand, surface, LayoutScale::one,
        "small doublets",
        [](Layout& l, const Owner& o, Values v) {
          add_to(l.surfaces[o.index].dead_band_rad, v[0] * base::kRadiansPerDegree);
        },
        1,
        [](const Layout& l, const Owner& o) {
          return l.surfaces[o.index].dead_band_rad * base::kDegreesPerRadian;
        }},
    Row{"fin_gain", "d *= 1 + k", kLayoutGain, surface, LayoutScale::one, "doublets at several amplitudes",
        [](Layout& l, const Owner& o, Values v) { l.surfaces[o.index].heard.scale *= 1 + v[0]; }},
    Row{"fin_lag", "lag += tau", kLayoutTau, surface, LayoutScale::one, "fast doublets",
        [](Layout& l, const Owner& o, Values v) { add_to(l.surfaces[o.index].lag_s, v[0]); }},
    Row{"fin_offset", "d += o", kLayoutAngle, surface, LayoutScale::one, "straight legs",
        [](Layout& l, const Owner& o, Values v) {
          l.surfaces[o.index].heard.offset += v[0] * base::kRadiansPerDegree;
        }},
    Row{"gravity_shift", "r_G += s", kLayoutPlaceShift, vehicle, LayoutScale::length_m,
        "lie still, then roll and pitch",
        [](Layout& l, const Owner&, Values v) { shift(l.body.gravity_centre_m, v); }, 3},
    Row{"mass_offset", "place of the mass += s", kLayoutWay, moving_mass, LayoutScale::length_m,
        "glide at several angles",
        [](Layout& l, const Owner& o, Values v) { l.moving_masses[o.index].heard.offset += v[0]; }},
    Row{"mass_scale", "place of the mass *= 1 + k", kLayoutGain, moving_mass, LayoutScale::one,
        "glide at several angles",
        [](Layout& l, const Owner& o, Values v) { l.moving_masses[o.index].heard.scale *= 1 + v[0]; }},
    Row{"thrust_scale", "thrust *= 1 + k", kLayoutScaleOf, thruster, LayoutScale::one,
        "speed steps on reciprocal legs", change_thrust_scale},
    Row{"thruster_dead_band", "dead band += b, in % of the command's range", kLayoutBand, thruster,
        LayoutScale::one, "small commands about neutral",
        [](Layout& l, const Owner& o, Values v) {
          add_to(l.thrusters[o.index].dead_band, v[0] / 100 * half_range(l.thrusters[o.index]));
        },
        1,
        [](const Layout& l, const Owner& o) {
          return 100 * l.thrusters[o.index].dead_band / half_range(l.thrusters[o.index]);
        }},
    Row{"thruster_lag", "lag += tau", kLayoutTau, thruster, LayoutScale::one, "fast steps of the command",
        [](Layout& l, const Owner& o, Values v) { add_to(l.thrusters[o.index].lag_s, v[0]); }},
    Row{"thruster_offset", "command += o, in % of its range", kLayoutPercent, thruster, LayoutScale::one,
        "hover, and steps up and down",
        [](Layout& l, const Owner& o, Values v) {
          l.thrusters[o.index].heard.offset += v[0] / 100 * half_range(l.thrusters[o.index]);
        }},
    Row{"weight", "m += dm, at the centre of gravity", kLayoutMass, vehicle, LayoutScale::mass_kg,
        "hover or glide with thrusters off", [](Layout& l, const Owner&, Values v) { l.body.mass_kg += v[0]; }},
    Row{"yaw_damping", "N -= k M66 r", kLayoutPerSecond, vehicle, LayoutScale::one, "turns at several rates",
        change_yaw_damping},
};

std::string_view word_of(LayoutPart part) {
  return base::enum_name<LayoutPart::freedom>(part, {"", "thruster", "surface", "ballast", "moving_mass", "", ""});
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

double scale_value(const config::Layout& layout, LayoutScale scale) {
  switch (scale) {
    case LayoutScale::mass_kg: return layout.body.mass_kg;
    case LayoutScale::weight_N: return layout.weight_N();
    case LayoutScale::length_m:
      // A vehicle in air displaces next to nothing: the water that weighs as much counts.
      return std::cbrt(std::max(layout.body.buoyancy_N, layout.weight_N()) /
                       (layout.water_density_kg_m3 * base::kGravity_m_s2));
    case LayoutScale::one: break;
  }
  return 1;
}

std::string_view scale_words(LayoutScale scale) {
  return base::enum_name<LayoutScale::length_m>(
      scale, {"", " of the mass", " of the weight", " of the cube root of the volume"});
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
  const auto found = std::ranges::find(kLayoutEffects, name, &LayoutEffectDescription::name);
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
  if (about.number != nullptr) {
    double least = std::numeric_limits<double>::infinity();
    for (const Owner& owner : named_owners(layout, about.part, {}))
      least = std::min(least, about.number(layout, owner));
    if (std::isfinite(least)) parameters.front().least = -least;
  }
  return parameters;
}

config::Layout changed_layout(config::Layout layout, const LayoutEffect& effect) {
  for (const Owner& owner : named_owners(layout, effect.about->part, effect.of))
    effect.about->change(layout, owner, effect.values);
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
