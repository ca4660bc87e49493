// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kWaterCurrent{.name = "water_current",
                                          .equation = "v_world += c",
                                          .parameters = {{"north_m_s", 0.06, -5, 5}, {"east_m_s", 0.06, -5, 5}},
                                          .manoeuvre = "run reciprocal legs at the surface",
                                          .confounders = {"thrust_scale", "declination"},
                                          .place = EffectPlace::vehicle,
                                          .vector = 2};

/// The water moves over the ground.
class WaterCurrent final : public EffectOf<WaterCurrent, kWaterCurrent> {
 public:
  void influence(double /*time_s*/, Influences& on) override {
    on.current_m_s[0] += p_[0];
    on.current_m_s[1] += p_[1];
  }
};

}  // namespace

std::unique_ptr<Effect> make_water_current() { return std::make_unique<WaterCurrent>(); }

}  // namespace navcal::sim
