// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 1> kBuoyancyParameters{{{"force_N", 0.4, -20, 20}}};

constexpr std::array<std::string_view, 2> kBuoyancyConfounders{"depth_scale", "elevator_offset"};

constexpr EffectDescription kBuoyancy{.name = "buoyancy",
                                      .equation = "Z_world -= F at the origin",
                                      .parameters = kBuoyancyParameters,
                                      .manoeuvre = "glide or hover with the propeller off",
                                      .confounders = kBuoyancyConfounders,
                                      .place = EffectPlace::vehicle};

/// The vehicle is not of the water's weight.
class Buoyancy final : public EffectOf<Buoyancy, 1> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kBuoyancy; }
  void influence(double /*time_s*/, Influences& on) override { on.buoyancy_N += p_[0]; }
};

}  // namespace

std::unique_ptr<Effect> make_buoyancy() { return std::make_unique<Buoyancy>(); }

}  // namespace navcal::sim
