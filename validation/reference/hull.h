// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace navcal::reference {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

inline constexpr double kGravity_m_s2 = 9.81;

/// The hull and what drives it, nominally. The numbers are those of config/vehicle.toml, written here a second
/// time on purpose (docs/trial.md): a slip in either shows as a disagreement of the two realities.
struct Hull {
  double length_m = 0.91;
  double diameter_m = 0.089;
  double mass_kg = 5.3;
  double gravity_centre_below_m = 0.010;  ///< of the origin, which is the centre of buoyancy
  double roll_inertia_factor = 0.88;      ///< Ix = factor * m * radius^2
  double pitch_inertia_factor = 0.85;     ///< Iy = Iz = factor * that of a full cylinder
  double roll_added_inertia = 0.3;        ///< of the roll inertia: the fins

  double axial_drag = 0.30;     ///< on the frontal area
  double crossflow_drag = 1.1;  ///< on the local diameter
  double lift_slope_per_rad = 0.6;
  double lift_area_m2 = 0.7 * 0.91 * 0.089;
  double lift_station_m = 0.05;  ///< forward of the origin

  double fin_area_m2 = 0.0048;
  double fin_lift_slope_per_rad = 3.0;
  double fin_induced_drag = 1.2;
  double fin_station_m = -0.40;
  double fin_radius_m = 0.085;  ///< of the centre of pressure
  double fin_time_s = 0.15;

  double propeller_diameter_m = 0.10;
  double thrust_at_rest = 0.35;       ///< KT0
  double thrust_per_advance = -0.32;  ///< KT1
  double torque_coefficient = 0.02;   ///< KQ
  double torque_share = 0.1;          ///< of the propeller's torque that reaches the hull
  double shaft_time_s = 0.5;

  double roll_damping_ratio = 0.25;
  double pitch_damping_ratio = 0.5;
  double yaw_damping_per_s = 0.15;

  double water_density_kg_m3 = 1000;  ///< the vehicle is trimmed to swim in it
};

/// Mass with the water that moves along: momenta about the origin = inertia * (velocity, rate), body axes, SI.
/// Rigid part with the centre of gravity below the origin; added part that of a prolate spheroid as long and as
/// thick (Lamb, Hydrodynamics, art. 114 and 115; Fossen, Handbook of Marine Craft Hydrodynamics, ch. 6).
[[nodiscard]] Matrix6 inertia(const Hull& hull);

}  // namespace navcal::reference
