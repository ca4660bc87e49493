// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 2> kWaterCurrentParameters{
    {{"north_m_s", 0.06, -5, 5}, {"east_m_s", 0.06, -5, 5}}};

constexpr std::array<std::string_view, 2> kWaterCurrentConfounders{"thrust_scale", "declination"};

constexpr EffectDescription kWaterCurrent{.name = "water_current",
                                          .equation = "v_world += c",
                                          .parameters = kWaterCurrentParameters,
                                          .manoeuvre = "run reciprocal legs at the surface",
                                          .confounders = kWaterCurrentConfounders,
                                          .place = EffectPlace::vehicle,
                                          .vector = 2};

/// The water moves over the ground.
class WaterCurrent final : public EffectOf<WaterCurrent, 2> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kWaterCurrent; }
  void influence(double /*time_s*/, Influences& on) override {
    on.current_m_s[0] += p_[0];
    on.current_m_s[1] += p_[1];
  }
};

}  // namespace

std::unique_ptr<Effect> make_water_current() { return std::make_unique<WaterCurrent>(); }

}  // namespace navcal::sim
