// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::base {

/// Acceleration of gravity, m/s2: of the vehicle's weight, and the g of the accelerometers' scale
/// (docs/simulator.md).
inline constexpr double kGravity_m_s2 = 9.81;

}  // namespace navcal::base
