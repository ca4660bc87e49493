// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kFinGain{.name = "fin_gain",
                                     .equation = "d *= 1 + k",
                                     .parameters = {{"scale", 0.08, -0.9, 1}},
                                     .manoeuvre = "rudder doublets of two sizes at two speeds",
                                     .confounders = {"fin_lag", "yaw_damping", "thrust_scale"},
                                     .place = EffectPlace::vehicle,
                                     .order = 0};

/// The fin turns further than the servo that is reported.
class FinGain final : public EffectOf<FinGain, kFinGain> {
 public:
  void link_fins(double /*time_s*/, double /*step_s*/, Vector3& fins_rad) override {
    for (double& fin_rad : fins_rad) fin_rad *= 1 + p_[0];
  }
};

}  // namespace

std::unique_ptr<Effect> make_fin_gain() { return std::make_unique<FinGain>(); }

}  // namespace navcal::sim
