// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "config/layout.h"

// What each effect of layout_effects.h does to one part of a layout. `values` are in the order of its parameters.
namespace navcal::sim::change {

using Values = std::span<const double>;

void thrust_scale(config::LayoutThruster& thruster, Values values);
void thruster_offset(config::LayoutThruster& thruster, Values values);
void thruster_lag(config::LayoutThruster& thruster, Values values);
void thruster_dead_band(config::LayoutThruster& thruster, Values values);
void fin_gain(config::LayoutSurface& surface, Values values);
void fin_offset(config::LayoutSurface& surface, Values values);
void fin_lag(config::LayoutSurface& surface, Values values);
void fin_dead_band(config::LayoutSurface& surface, Values values);
void ballast_scale(config::LayoutBallast& ballast, Values values);
void ballast_offset(config::LayoutBallast& ballast, Values values);
void mass_scale(config::LayoutMovingMass& mass, Values values);
void mass_offset(config::LayoutMovingMass& mass, Values values);
void dead(config::LayoutHeard& heard, Values values);
void reversed(config::LayoutHeard& heard, Values values);
/// `freedom`: 0 surge to 5 yaw.
void damping(config::Layout& layout, std::size_t freedom, Values values);
void added_mass(config::Layout& layout, std::size_t freedom, Values values);
void weight(config::Layout& layout, Values values);
void buoyancy(config::Layout& layout, Values values);
void gravity_shift(config::Layout& layout, Values values);
void buoyancy_shift(config::Layout& layout, Values values);
void yaw_damping(config::Layout& layout, Values values);

}  // namespace navcal::sim::change
