// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 1> kThrustScaleParameters{{{"scale", 0.08, -0.9, 1}}};

constexpr std::array<std::string_view, 3> kThrustScaleConfounders{"water_current", "fin_gain", "accel_scale"};

constexpr EffectDescription kThrustScale{.name = "thrust_scale",
                                         .equation = "thrust *= 1 + k",
                                         .parameters = kThrustScaleParameters,
                                         .manoeuvre = "run reciprocal legs with speed steps at the surface",
                                         .confounders = kThrustScaleConfounders,
                                         .place = EffectPlace::vehicle};

/// The propeller pushes more than nominal.
class ThrustScale final : public EffectOf<ThrustScale, 1> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kThrustScale; }
  void influence(double /*time_s*/, Influences& on) override { on.thrust_factor *= 1 + p_[0]; }
};

}  // namespace

std::unique_ptr<Effect> make_thrust_scale() { return std::make_unique<ThrustScale>(); }

}  // namespace navcal::sim
