// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "validation/reference/hull.h"
#include "validation/reference/parameter_deviations.h"

/// A second reality for vehicles with thrusters (docs/trial.md). It reads the layouts of docs/vehicles.md by
/// itself.
namespace navcal::reference::thrusters {

/// What is wrong with one thruster. Orders are in half ranges: 1 is the way from neutral to a limit of +-100 % or
/// of 400 us.
struct RotorDeviations {
  double scale = 0;      ///< force times 1 + scale
  double offset = 0;     ///< added to the order
  double lag_s = 0;      ///< further first-order lag of the speed controller
  double dead_band = 0;  ///< wider than the layout's by this, to each side
  bool reversed = false;
  bool dead = false;
  double fouling_per_s = 0;  ///< beyond the library: loss of force that grows with time
};

/// What is different about the vehicle, its instruments apart. Zeros: nothing.
struct CraftDeviations {
  std::vector<RotorDeviations> rotors;   ///< one for each thruster; fewer: the others are sound
  Vector6 damping = Vector6::Zero();     ///< relative, of the force along each axis
  Vector6 added_mass = Vector6::Zero();  ///< relative, along each axis
  double mass_kg = 0;                    ///< carried at the centre of gravity
  double lift_N = 0;                     ///< upwards at the centre of buoyancy
  Vector3 gravity_shift_m = Vector3::Zero();

  // Beyond the library.
  double sag = 0;          ///< loss of the supply's voltage at full load of all thrusters, relative
  double tether_kg_m = 0;  ///< drag of a cable at the stern over the square of the speed, at 10 m of it
  double sway_jet = 0;     ///< share of the thrust that a flow across the rotor takes away
  double wave_m = 0;       ///< amplitude of a swell beyond the sea's own
  double leak_N_s = 0;     ///< growth of the weight
};

/// How this reality differs from every layout, whatever the vehicle: what no layout has a number for.
struct Nature {
  double resistance = 0.3;     ///< share of the voltage lost in the windings at full load
  double overshoot = 0.15;     ///< thrust of a rotor whose wake is not built up, over its steady thrust, less 1
  double rotor_inertia = 0.1;  ///< reaction of a rotor that spins up within its lag, over its full torque
  double jet_loss = 0.02;      ///< share of the thrust that a flow across the rotor takes at most
  double strips = 0.05;        ///< share of a diagonal's quadratic drag across that is spread over the length
  double current_m_s = 0.003;  ///< amplitude of the slow changes of the current
  double wave_m = 0.005;       ///< amplitude at the surface
};

enum class OrderUnit : std::uint8_t { rpm, percent, microseconds };

/// One thruster as the layout describes it: SI, command in its own unit.
struct PlannedThruster {
  std::string name;
  Vector3 place_m = Vector3::Zero();
  Vector3 direction = Vector3::UnitX();  ///< unit vector of its forward thrust
  OrderUnit unit = OrderUnit::percent;
  double low = -100, high = 100;  ///< limits of the command
  double dead_band = 0;
  double lag_s = 0.1;
  double reverse_efficiency = 1;
  double reaction_sign = -1;  ///< of the reaction about `direction` at forward thrust: -1 right-handed
  double torque_share = 1;
  /// Force over command at rest, linear between its points; empty for a propeller.
  std::vector<double> command, force_N;
  double advance_loss = 0;  ///< sqrt(N) s/m: T = T0 - k sqrt|T0| u
  double torque_arm_m = 0;  ///< torque over thrust
  /// Propeller: coefficients over the advance ratio.
  double diameter_m = 0;
  std::vector<double> KT, KQ;

  [[nodiscard]] double neutral() const { return unit == OrderUnit::microseconds ? 1500 : 0; }
  /// Steady thrust at rest, N, at a command within the limits; nothing within the dead band.
  [[nodiscard]] double bollard_N(double order, double density_kg_m3) const;
};

/// A slice of the hull across x.
struct Slice {
  double x_m = 0, length_m = 0, width_m = 0, height_m = 0;
};

/// The vehicle of a layout whose only actuators are thrusters.
struct Plan {
  std::string name;
  double density_kg_m3 = 1000;
  double mass_kg = 0;
  Vector3 gravity_centre_m = Vector3::Zero();
  Vector3 buoyancy_centre_m = Vector3::Zero();
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about the centre of gravity
  double buoyancy_N = 0;                                    ///< at kGravity_m_s2
  Vector3 size_m = Vector3::Zero();
  Matrix6 added_mass = Matrix6::Zero();
  Matrix6 linear = Matrix6::Zero(), quadratic = Matrix6::Zero(), lift = Matrix6::Zero();
  double axial_kg_m = 0;                       ///< X = -k |u| u
  double body_lift_kg_m = 0, body_lift_m = 0;  ///< Y = -k |u| v at this x, Z likewise
  double crossflow = 0;                        ///< coefficient on the slices
  std::vector<Slice> slices;
  std::vector<PlannedThruster> thrusters;
};

/// Reads the text of a layout. Throws std::invalid_argument, which names the key, for what is no layout and for
/// what this reality does not have: surfaces, ballast, moving masses, forces in axes of the flow.
[[nodiscard]] Plan plan_of(std::string_view toml);

/// Mass of the vehicle with the water that moves along, about the origin.
[[nodiscard]] Matrix6 inertia(const Plan& plan);

}  // namespace navcal::reference::thrusters
