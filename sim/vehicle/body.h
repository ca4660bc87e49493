// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <stdexcept>

namespace navcal::sim {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Position, attitude and velocity of a vehicle. The origin is its centre of buoyancy; body axes x forward, y
/// starboard, z down; world axes north, east, down.
struct Body {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d euler_rad = Eigen::Vector3d::Zero();  ///< roll, pitch, yaw; yaw is not wrapped
  Vector6 velocity = Vector6::Zero();                   ///< u, v, w through the water; p, q, r
};

/// Body forces X, Y, Z and moments K, M, N about the origin, of a force acting at a point.
inline Vector6 force_at(const Eigen::Vector3d& point_m, const Eigen::Vector3d& force_N) {
  Vector6 all;
  all << force_N, point_m.y() * force_N.z() - point_m.z() * force_N.y(),
      point_m.z() * force_N.x() - point_m.x() * force_N.z(), point_m.x() * force_N.y() - point_m.y() * force_N.x();
  return all;
}

/// The motion left what the model can describe; what() says when and in which state.
class UnstableVehicle : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws UnstableVehicle when the state is not finite, faster than anything of this size moves, or stands on its
/// nose, where Euler angles end.
void check_stable(const Body& body, double time_s);

}  // namespace navcal::sim
