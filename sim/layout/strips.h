// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "config/layout.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// Cross-flow drag by strips (Fossen 2011, chapter 6). A strip at x, dx long, w wide and h high, meets
/// (vl, wl) = (v + x r, w - x q) and feels
///   dY = -1/2 rho Cd h sqrt(vl^2 + wl^2) vl dx,   dZ = -1/2 rho Cd w sqrt(vl^2 + wl^2) wl dx;
///   N += x dY, M -= x dZ.
class CrossFlowStrips {
 public:
  CrossFlowStrips(const config::LayoutStrips& strips, double coefficient, double density_kg_m3);

  /// Adds the forces about the origin at this body velocity.
  void add(const Vector6& velocity, Vector6& force) const;

 private:
  /// The processor takes strips two at a time; the last block is filled up with strips without width.
  static constexpr Eigen::Index kBlock = 4;
  using Strips = Eigen::Array<double, kBlock, 1>;
  struct Block {
    Strips x_m = Strips::Zero(), sway_kg_m = Strips::Zero(), heave_kg_m = Strips::Zero();
  };
  std::vector<Block> blocks_;
};

}  // namespace navcal::sim
