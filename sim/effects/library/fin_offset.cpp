// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kFinOffset{.name = "fin_offset",
                                       .equation = "d += mixed rudder o",
                                       .parameters = {{"angle_deg", 1, -20, 20}},
                                       .manoeuvre = "rudder doublets, straight",
                                       .confounders = {"fin_gain", "elevator_offset"},
                                       .place = EffectPlace::vehicle};

/// The fins stand off in the sense of a rudder command, between servo and fin.
class FinOffset final : public EffectOf<FinOffset, kFinOffset> {
 public:
  void link_fins(double /*time_s*/, double /*step_s*/, Vector3& fins_rad) override {
    const double rudder_rad = p_[0] * std::numbers::pi / 180;
    add_scaled(fins_rad, rudder_rad, {-1, 0.5, 0.5});  // docs/simulator.md: how rudder and elevator mix
  }
};

}  // namespace

std::unique_ptr<Effect> make_fin_offset() { return std::make_unique<FinOffset>(); }

}  // namespace navcal::sim
