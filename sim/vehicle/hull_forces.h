// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "config/vehicle.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// Hydrodynamic forces on the bare hull, SI units, body axes, about the origin:
/// - axial drag X = -1/2 rho Cd0 (pi D^2/4) |u| u;
/// - cross-flow drag by strips (Fossen 2011, chapter 6): a strip at x, dx long and d(x) wide, meets
///   (vl, wl) = (v + x r, w - x q) and feels dY = -1/2 rho Cdc d sqrt(vl^2 + wl^2) vl dx, dZ likewise with wl;
///   N += x dY, M -= x dZ;
/// - body lift Y = -1/2 rho S CLb |u| v, Z the same with w, acting at xl: N += xl Y, M -= xl Z.
class HullForces {
 public:
  HullForces(const config::HullSettings& hull, const config::WaterSettings& water);

  [[nodiscard]] Vector6 operator()(const Vector6& velocity) const;

 private:
  /// 21 stations, evenly from stern to bow; the two at the ends have no width, and one of them stands here so that
  /// the processor can take the strips two at a time.
  static constexpr Eigen::Index kStrips = 20;
  using Strips = Eigen::Array<double, kStrips, 1>;

  double axial_kg_m_;
  double lift_kg_m_;
  double lift_at_m_;
  Strips x_m_, drag_kg_m_;  ///< of each strip: where it is, and 1/2 rho Cdc d dx
};

}  // namespace navcal::sim
