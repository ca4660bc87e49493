// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 1> kFinOffsetParameters{{{"angle_deg", 1, -20, 20}}};

constexpr std::array<std::string_view, 2> kFinOffsetConfounders{"fin_gain", "elevator_offset"};

constexpr EffectDescription kFinOffset{.name = "fin_offset",
                                       .equation = "d += mixed rudder o",
                                       .parameters = kFinOffsetParameters,
                                       .manoeuvre = "rudder doublets, straight",
                                       .confounders = kFinOffsetConfounders,
                                       .place = EffectPlace::vehicle};

/// The fins stand off in the sense of a rudder command, between servo and fin.
class FinOffset final : public EffectOf<FinOffset, 1> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kFinOffset; }
  void link_fins(double /*time_s*/, double /*step_s*/, Vector3& fins_rad) override {
    const double rudder_rad = p_[0] * std::numbers::pi / 180;
    add_scaled(fins_rad, rudder_rad, {-1, 0.5, 0.5});  // docs/simulator.md: how rudder and elevator mix
  }
};

}  // namespace

std::unique_ptr<Effect> make_fin_offset() { return std::make_unique<FinOffset>(); }

}  // namespace navcal::sim
