// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "config/vehicle.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// Three fins about the tail, 120 degrees apart: the first up, the second to starboard and down, the third to port
/// and down. Fin i at r_i with normal n_i meets V = v + omega x r_i:
///   alpha = delta_i - atan2(V.n, max(|V_x|, 0.001)), held within +-stall; q = 1/2 rho A (V_x^2 + (V.n)^2);
///   force q aL alpha n - q CD alpha^2 x. SI units, body axes, about the origin.
class FinForces {
 public:
  FinForces(const config::FinSettings& fins, const config::WaterSettings& water);

  [[nodiscard]] Vector6 operator()(const Vector6& velocity, const Eigen::Vector3d& angles_rad) const;

 private:
  struct Fin {
    Vector6 of_normal,
        of_axis;  ///< generalised force about the origin of a unit force along the normal, and along x
  };

  config::FinSettings settings_;
  double pressure_kg_m_;  ///< 1/2 rho A
  std::array<Fin, 3> fins_;
};

}  // namespace navcal::sim
