// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/layout.h"
#include "sim/layout/actuators.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// Skew-symmetric matrix S(a) with S(a) b = a x b.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Symmetric matrix of inertia about the centre of gravity, kg m2.
[[nodiscard]] Eigen::Matrix3d inertia_matrix(const config::LayoutBody& body);

/// M_RB about the origin (Fossen 2011, equation 3.44), kg, kg m, kg m2:
///   M_RB = [ m 1, -m S(r_g); m S(r_g), I_g - m S(r_g) S(r_g) ].
/// Moving masses at these places along their axes (m): r_g moves by sum m_i s_i a_i / m, and the inertia about the
/// origin by the difference of their point masses' own, -m_i (S(r_i')^2 - S(r_i)^2).
[[nodiscard]] Matrix6 rigid_body_mass(const config::Layout& layout, const ActuatorNumbers& masses_m);

/// Centre of gravity with moving masses at these places, m.
[[nodiscard]] Eigen::Vector3d gravity_centre_m(const config::Layout& layout, const ActuatorNumbers& masses_m);

}  // namespace navcal::sim
