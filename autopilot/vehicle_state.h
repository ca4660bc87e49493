// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace navcal::autopilot {

/// State that the autopilot uses: the true one in the simulator, estimates on a vehicle.
struct VehicleState {
  double depth_m = 0;
  Eigen::Vector3d euler_rad = Eigen::Vector3d::Zero();   ///< roll, pitch, yaw; yaw is not wrapped
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();  ///< body rates p, q, r
  double surge_m_s = 0;                                  ///< through the water
};

}  // namespace navcal::autopilot
