// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "validation/reference/thrusters/plan.h"

namespace navcal::reference::thrusters {

/// Force along the thruster's direction, and moment on the hull about it.
struct Push {
  double force_N = 0, moment_Nm = 0;
};

/// One thruster: speed controller, motor, propeller, wake. The state is the shaft speed s, 1 at the upper limit of
/// the command, and the speed w of the wake in the same measure (w = s when it has built up).
///   controller   the steady speed s* of a command is that whose thrust at rest the layout states; voltage
///                V = (1 - r) s* + r s*|s*|, r the share that the windings lose at full load
///   motor        T s' = V (1 - sag) - (1 - r) s - r s|s|: the torque of the water grows with the square; T makes
///                the time constant at half speed the layout's lag, faster above and slower below it
///   wake         w' = (s - w) max(|s|, |w|, 0.05) c / l (Healey et al., IEEE J. Oceanic Eng. 20, 1995: the water
///   in
///                the duct has inertia, and thrust overshoots until it moves), l one diameter, c the jet's speed
///   thrust       T0(s) = s|s| times the thrust at the limit of this direction, plus overshoot
///                g |s| (s - w) of it; less with the advance ratio as the layout states; less in a flow across:
///                1 - j u^2/(u^2 + (c s)^2)
class Rotor {
 public:
  Rotor(const PlannedThruster& thruster, double density_kg_m3, const RotorDeviations& deviations,
        const Nature& nature);

  /// From now on, in the command's unit. `after_s`: since settle() was called.
  void order(double command);
  /// Takes the present as the new beginning of the controller's lag.
  void settle(double after_s);

  /// s' and w', 1/s.
  struct Rates {
    double speed = 0, wake = 0;
  };
  [[nodiscard]] Rates rates(double speed, double wake, double after_s, double sag) const;
  /// `advance_m_s`: of the thruster along its direction; `across_m_s`: square to it. `spin_up`: s'.
  [[nodiscard]] Push push(double speed, double wake, double spin_up, double advance_m_s, double across_m_s,
                          double time_s) const;
  /// Share of full load that the motor draws from its supply.
  [[nodiscard]] static double load(double speed) { return std::abs(speed * speed * speed); }

  [[nodiscard]] const Vector3& place_m() const { return place_m_; }
  [[nodiscard]] const Vector3& direction() const { return direction_; }

 private:
  [[nodiscard]] double steady_speed(double command) const;
  [[nodiscard]] double voltage(double after_s) const;
  [[nodiscard]] double shaft_rev_s(double speed) const;  ///< of a propeller that the layout gives in rpm
  [[nodiscard]] double thrust_at_rest(double speed) const;
  [[nodiscard]] double advanced(double at_rest_N, double speed, double advance_m_s) const;

  PlannedThruster thruster_;
  double density_kg_m3_;
  RotorDeviations deviations_;
  Nature nature_;
  Vector3 place_m_, direction_;
  double forward_N_, reverse_N_;  ///< at rest, at the limits; magnitudes
  double full_torque_Nm_, jet_m_s_, duct_m_;
  double voltage_ = 0, ordered_voltage_ = 0;
};

}  // namespace navcal::reference::thrusters
