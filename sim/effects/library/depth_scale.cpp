// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kDepthScale{.name = "depth_scale",
                                        .equation = "z += s z",
                                        .parameters = {{"scale", 0.06, -0.9, 1}},
                                        .manoeuvre = "hold two depths far apart",
                                        .confounders = {"buoyancy"}};

/// The pressure gauge's scale is off.
class DepthScale final : public EffectOf<DepthScale, kDepthScale> {
 public:
  void depth(const Instant& now, double& depth_m) override { depth_m += p_[0] * now.state.position_m[2]; }
};

}  // namespace

std::unique_ptr<Effect> make_depth_scale() { return std::make_unique<DepthScale>(); }

}  // namespace navcal::sim
