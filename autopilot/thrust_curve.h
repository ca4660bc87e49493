// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/layout.h"

namespace navcal::autopilot {

/// Force along a thruster's direction, and the moment of its propeller on the hull about that direction.
struct Thrust {
  double force_N = 0, torque_Nm = 0;
};

/// Steady thrust at a position of the actuator (its command after lag and dead band) and an advance speed, which
/// is the thruster's own speed along its direction, in water of this density. Propeller at n rev/s (Fossen 2011,
/// chapter 12): J = u_a/(n D), not below zero;
///   T = rho n^2 D^4 max(KT(J), 0), Q = rho n^2 D^5 KQ(J); in reverse both times the reverse efficiency.
/// Table: T = T0(c) - k sqrt(|T0|) u_a, and never of the other sign than T0. T0 grows with n^2, so this is the
/// bilinear thrust T = a n|n| - b |n| u_a of Fossen. Commands beyond the table take its ends.
[[nodiscard]] Thrust thrust_at(const config::LayoutThruster& thruster, double density_kg_m3, double position,
                               double advance_m_s);

/// The command within its limits; neutral within the dead band, and in part across the width of its end.
[[nodiscard]] double effective_command(const config::LayoutThruster& thruster, double command);

/// The command within limits whose thrust comes nearest to the wanted one. Beyond what the thruster gives, its
/// limit.
[[nodiscard]] double command_for(const config::LayoutThruster& thruster, double density_kg_m3, double force_N,
                                 double advance_m_s);

}  // namespace navcal::autopilot
