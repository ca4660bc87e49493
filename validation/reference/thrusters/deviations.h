// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "validation/reference/hull.h"
#include "validation/reference/parameter_deviations.h"

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

}  // namespace navcal::reference::thrusters
