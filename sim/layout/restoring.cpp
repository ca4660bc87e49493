// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/restoring.h"

#include <cmath>

#include "sim/layout/mass_matrix.h"
#include "sim/layout/vector_of.h"

namespace navcal::sim {

Restoring restoring_of(const config::Layout& layout, const ActuatorNumbers& ballasts_N,
                       const ActuatorNumbers& masses_m) {
  const double weight = layout.weight_N();
  Restoring restoring;
  restoring.net_weight_N = weight - layout.body.buoyancy_N;
  restoring.arm_Nm = weight * gravity_centre_m(layout, masses_m) -
                     layout.body.buoyancy_N * vector_of(layout.body.buoyancy_centre_m);
  for (std::size_t i = 0; i < layout.ballasts.size(); ++i) {
    restoring.net_weight_N -= ballasts_N[i];
    restoring.arm_Nm -= ballasts_N[i] * vector_of(layout.ballasts[i].place_m);
  }
  return restoring;
}

Eigen::Vector3d down_of(const Eigen::Vector3d& euler_rad) {
  const double ct = std::cos(euler_rad[1]);
  return {-std::sin(euler_rad[1]), ct * std::sin(euler_rad[0]), ct * std::cos(euler_rad[0])};
}

}  // namespace navcal::sim
