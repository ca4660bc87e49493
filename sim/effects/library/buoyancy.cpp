// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kBuoyancy{.name = "buoyancy",
                                      .equation = "Z_world -= F at the origin",
                                      .parameters = {{"force_N", 0.4, -20, 20}},
                                      .manoeuvre = "glide or hover with the propeller off",
                                      .confounders = {"depth_scale", "elevator_offset"},
                                      .place = EffectPlace::vehicle};

/// The vehicle is not of the water's weight.
class Buoyancy final : public EffectOf<Buoyancy, kBuoyancy> {
 public:
  void influence(double /*time_s*/, Influences& on) override { on.buoyancy_N += p_[0]; }
};

}  // namespace

std::unique_ptr<Effect> make_buoyancy() { return std::make_unique<Buoyancy>(); }

}  // namespace navcal::sim
