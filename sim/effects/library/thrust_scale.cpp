// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kThrustScale{.name = "thrust_scale",
                                         .equation = "thrust *= 1 + k",
                                         .parameters = {{"scale", 0.08, -0.9, 1}},
                                         .manoeuvre = "run reciprocal legs with speed steps at the surface",
                                         .confounders = {"water_current", "fin_gain", "accel_scale"},
                                         .place = EffectPlace::vehicle};

/// The propeller pushes more than nominal.
class ThrustScale final : public EffectOf<ThrustScale, kThrustScale> {
 public:
  void influence(double /*time_s*/, Influences& on) override { on.thrust_factor *= 1 + p_[0]; }
};

}  // namespace

std::unique_ptr<Effect> make_thrust_scale() { return std::make_unique<ThrustScale>(); }

}  // namespace navcal::sim
