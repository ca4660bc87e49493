// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/layout/layout_vehicle.h"

namespace navcal::sim {

/// Depth by ballast and moving masses. With e = depth demanded - depth - 20 s times the speed down, and s =
/// clamp(e/2 m, -1, 1): the ballast goes to the part s of its range on the heavy side (below zero: light), and
/// moving masses to where weight and buoyancy balance at a pitch of -25 degrees times s, with an integral of the
/// pitch.
class GlideControl {
 public:
  explicit GlideControl(const LayoutVehicle& vehicle);

  /// Writes the commands of ballasts and moving masses.
  void command(double depth_demanded_m, const Body& body, double period_s, ActuatorValues& commands);

 private:
  config::Layout layout_;
  double stiffness_Nm_;        ///< W times the metacentric height
  double net_weight_N_;        ///< with ballast at zero
  double pitch_integral_ = 0;  ///< rad s
};

}  // namespace navcal::sim
