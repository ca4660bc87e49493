// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace navcal::report {

/// Roll, pitch and yaw about fixed axes, rad, of R = Rz(yaw) Ry(pitch) Rx(roll): the convention of the
/// rotations in files of HoloOcean and Stonefish.
[[nodiscard]] inline Eigen::Vector3d fixed_axis_angles(const Eigen::Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)), std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace navcal::report
