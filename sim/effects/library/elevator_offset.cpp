// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kElevatorOffset{.name = "elevator_offset",
                                            .equation = "d += mixed elevator o",
                                            .parameters = {{"angle_deg", 1, -20, 20}},
                                            .manoeuvre = "elevator doublets, level",
                                            .confounders = {"fin_gain", "fin_offset"},
                                            .place = EffectPlace::vehicle};

/// The fins stand off in the sense of an elevator command, between servo and fin.
class ElevatorOffset final : public EffectOf<ElevatorOffset, kElevatorOffset> {
 public:
  void link_fins(double /*time_s*/, double /*step_s*/, Vector3& fins_rad) override {
    const double elevator_rad = p_[0] * std::numbers::pi / 180;
    constexpr double kShare = std::numbers::sqrt3 / 2;  // docs/simulator.md: how rudder and elevator mix
    add_scaled(fins_rad, elevator_rad, {0, kShare, -kShare});
  }
};

}  // namespace

std::unique_ptr<Effect> make_elevator_offset() { return std::make_unique<ElevatorOffset>(); }

}  // namespace navcal::sim
