// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/strips.h"

namespace navcal::sim {

CrossFlowStrips::CrossFlowStrips(const config::LayoutStrips& strips, double coefficient, double density_kg_m3) {
  for (std::size_t i = 0; i < strips.x_m.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i) % kBlock;
    if (place == 0) blocks_.emplace_back();
    const double per_width = 0.5 * density_kg_m3 * coefficient * strips.length_m[i];
    blocks_.back().x_m[place] = strips.x_m[i];
    blocks_.back().sway_kg_m[place] = per_width * strips.height_m[i];
    blocks_.back().heave_kg_m[place] = per_width * strips.width_m[i];
  }
}

void CrossFlowStrips::add(const Vector6& velocity, Vector6& force) const {
  const double v = velocity[1], w = velocity[2], q = velocity[4], r = velocity[5];
  Strips Y = Strips::Zero(), Z = Strips::Zero(), M = Strips::Zero(), N = Strips::Zero();
  for (const Block& block : blocks_) {
    const Strips vl = v + r * block.x_m;
    const Strips wl = w - q * block.x_m;
    const Strips speed = (vl.square() + wl.square()).sqrt();
    const Strips across = block.sway_kg_m * speed * vl, down = block.heave_kg_m * speed * wl;
    Y += across;
    Z += down;
    N += block.x_m * across;
    M += block.x_m * down;
  }
  force[1] -= Y.sum();
  force[2] -= Z.sum();
  force[4] += M.sum();
  force[5] -= N.sum();
}

}  // namespace navcal::sim
