// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/vehicle.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// A propeller on the axis, n in revolutions a second: X = rho n^2 D^4 KT and K = k rho n^2 D^5 KQ, with
/// KT = max(KT0 + KT1 J, 0) and J = max(u, 0)/(n D); nothing when it does not turn forwards. Of its torque only
/// the part k reaches the hull: the rest is taken back from the wake by the fins.
class Propeller {
 public:
  Propeller(const config::PropellerSettings& propeller, const config::WaterSettings& water);

  struct Force {
    double thrust_N, torque_Nm;
  };
  [[nodiscard]] Force at(double surge_m_s, double shaft_rps) const;

 private:
  config::PropellerSettings settings_;
  double density_kg_m3_;
};

/// Current that the motor draws at this shaft speed: I = I0 + k n^3.
[[nodiscard]] double current_A(const config::PropellerSettings& propeller, double shaft_rps);

}  // namespace navcal::sim
