// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/layout.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// Forces of a lifting body about the origin, body axes (Graver 2005, Underwater Gliders: Dynamics, Control and
/// Design, chapter 3). With V the speed, alpha = atan2(w, u), beta = asin(v/V), both held within the stall angle
/// in the coefficients:
///   L = (l0 + l1 alpha) V^2, D = (d0 + d1 alpha^2) V^2, S = -s beta V^2;
///   K = k beta V^2, M = (m0 + m1 alpha) V^2, N = n beta V^2.
/// Drag acts against the velocity, lift across it in the plane of u and w (up in level motion ahead), S along y.
[[nodiscard]] Vector6 flow_axes_force(const config::LayoutFlowAxes& flow, const Vector6& velocity);

}  // namespace navcal::sim
