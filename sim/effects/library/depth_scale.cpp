// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 1> kDepthScaleParameters{{{"scale", 0.06, -0.9, 1}}};

constexpr std::array<std::string_view, 1> kDepthScaleConfounders{"buoyancy"};

constexpr EffectDescription kDepthScale{.name = "depth_scale",
                                        .equation = "z += s z",
                                        .parameters = kDepthScaleParameters,
                                        .manoeuvre = "hold two depths far apart",
                                        .confounders = kDepthScaleConfounders};

/// The pressure gauge's scale is off.
class DepthScale final : public EffectOf<DepthScale, 1> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kDepthScale; }
  void depth(const Instant& now, double& depth_m) override { depth_m += p_[0] * now.state.position_m[2]; }
};

}  // namespace

std::unique_ptr<Effect> make_depth_scale() { return std::make_unique<DepthScale>(); }

}  // namespace navcal::sim
