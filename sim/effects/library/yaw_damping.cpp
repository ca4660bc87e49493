// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kYawDamping{.name = "yaw_damping",
                                        .equation = "N -= k M66 r",
                                        .parameters = {{"per_s", 0.3, -0.15, 10}},
                                        .manoeuvre = "rudder doublets of two sizes at two speeds",
                                        .confounders = {"fin_gain", "fin_lag", "thrust_scale"},
                                        .place = EffectPlace::vehicle};

/// The hull resists turning more than nominal.
class YawDamping final : public EffectOf<YawDamping, kYawDamping> {
 public:
  void influence(double /*time_s*/, Influences& on) override { on.yaw_damping_per_s += p_[0]; }
};

}  // namespace

std::unique_ptr<Effect> make_yaw_damping() { return std::make_unique<YawDamping>(); }

}  // namespace navcal::sim
