// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace navcal::base {

/// Roll, pitch and yaw of one frame in another: turns about z (yaw), then the new y (pitch), then the new x
/// (roll).
struct EulerAngles {
  double roll_rad = 0;
  double pitch_rad = 0;
  double yaw_rad = 0;
};

/// R with v_outer = R v_inner, where the inner frame has these angles in the outer one (Fossen, Handbook of Marine
/// Craft Hydrodynamics and Motion Control, eq. 2.18).
[[nodiscard]] inline Eigen::Matrix3d rotation_of(const EulerAngles& angles) {
  const double cr = std::cos(angles.roll_rad), sr = std::sin(angles.roll_rad);
  const double cp = std::cos(angles.pitch_rad), sp = std::sin(angles.pitch_rad);
  const double cy = std::cos(angles.yaw_rad), sy = std::sin(angles.yaw_rad);
  Eigen::Matrix3d rotation;
  rotation << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,          //
      -sp, cp * sr, cp * cr;
  return rotation;
}

/// The inverse: pitch within -pi/2 and pi/2. At these limits only the difference of roll and yaw has a meaning.
[[nodiscard]] inline EulerAngles angles_of(const Eigen::Matrix3d& rotation) {
  return {std::atan2(rotation(2, 1), rotation(2, 2)), -std::asin(std::clamp(rotation(2, 0), -1.0, 1.0)),
          std::atan2(rotation(1, 0), rotation(0, 0))};
}

/// How far below the origin a point of the body lies, m.
[[nodiscard]] inline double depth_below_origin_m(const Eigen::Vector3d& position_m, double roll_rad,
                                                 double pitch_rad) {
  return -std::sin(pitch_rad) * position_m.x() + std::cos(pitch_rad) * std::sin(roll_rad) * position_m.y() +
         std::cos(pitch_rad) * std::cos(roll_rad) * position_m.z();
}

}  // namespace navcal::base
