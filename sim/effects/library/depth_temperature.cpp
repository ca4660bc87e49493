// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kDepthTemperature{.name = "depth_temperature",
                                              .equation = "z += c T, T above 15 C",
                                              .parameters = {{"m_per_C", 0.025, -1, 1}},
                                              .manoeuvre = "hold one depth while the electronics warm up",
                                              .confounders = {"buoyancy", "depth_scale"}};

/// The pressure gauge's zero moves as the electronics warm up.
class DepthTemperature final : public EffectOf<DepthTemperature, kDepthTemperature> {
 public:
  void depth(const Instant& now, double& depth_m) override { depth_m += p_[0] * now.temperature_rise_C(); }
};

}  // namespace

std::unique_ptr<Effect> make_depth_temperature() { return std::make_unique<DepthTemperature>(); }

}  // namespace navcal::sim
