#pragma once

#include <array>

#include "config/vehicle.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// What the water does to the bare hull, SI units, body axes, about the origin:
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
  struct Strip {
    double x_m;
    double drag_kg_m;  ///< 1/2 rho Cdc d dx
  };
  /// 21 stations, evenly from stern to bow; the two at the ends have no width.
  static constexpr std::size_t kStrips = 19;

  double axial_kg_m_;
  double lift_kg_m_;
  double lift_at_m_;
  std::array<Strip, kStrips> strips_{};
};

}  // namespace navcal::sim
