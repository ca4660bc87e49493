// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/layout/assessment/assessment.h"
#include "sim/layout/layout_vehicle.h"

// Parts of the assessment of a layout.
namespace navcal::sim::assessment {

/// Trim: downwards lies along s = W (r_g - r_b). Periods: with k = W times the height of s in body axes, a free
/// vehicle swings with omega^2 = k (M^-1)_44 in roll and k (M^-1)_55 in pitch; ratio D (M^-1)_ii / (2 omega).
[[nodiscard]] Statics statics_of(const LayoutVehicle& vehicle);

/// Every thruster that points ahead at this part of its range ahead, those that point aft likewise in reverse.
[[nodiscard]] ActuatorValues ahead_at(const config::Layout& layout, double part);

/// Speeds ahead at 25, 50, 75 and 100 % of the command. Empty without thrusters along the axis.
[[nodiscard]] std::vector<SteadySpeed> speeds_ahead(const LayoutVehicle& vehicle);
/// Speeds downwards: neutral where weight and buoyancy differ, at the ends of the ballast, by thrusters that point
/// up or down.
[[nodiscard]] std::vector<SteadySpeed> speeds_downwards(const LayoutVehicle& vehicle);

/// Full ahead with surfaces neutral; full rudder full ahead, or a turn on the spot; glides.
[[nodiscard]] std::vector<SteadyMotion> motions_of(const LayoutVehicle& vehicle, double speed_ahead_m_s);

/// Why the equations cannot be integrated: mass matrix not positive definite, or numbers that are not finite.
[[nodiscard]] std::string reason_not_to_simulate(const config::Layout& layout);

/// Oddities of the layout itself, and of what the assessment found so far.
[[nodiscard]] std::vector<Oddity> oddities_of_file(const config::Layout& layout);
[[nodiscard]] std::vector<Oddity> oddities_of_motion(const LayoutVehicle& vehicle, const Assessment& found);

}  // namespace navcal::sim::assessment
