// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kFinBacklash{.name = "fin_backlash",
                                         .equation = "d stays within b/2 of the servo",
                                         .parameters = {{"width_deg", 2, 0, 30}},
                                         .manoeuvre = "small fin reversals about zero",
                                         .confounders = {"fin_lag"},
                                         .place = EffectPlace::vehicle,
                                         .order = 2,
                                         .kind = EffectKind::backlash};

/// Backlash of total width b between the servo that is reported and the fin.
class FinBacklash final : public EffectOf<FinBacklash, kFinBacklash> {
 public:
  void link_fins(double /*time_s*/, double /*step_s*/, Vector3& fins_rad) override {
    if (!begun_) fins_rad_ = fins_rad;
    begun_ = true;
    const double half_rad = p_[0] * std::numbers::pi / 360;
    for (std::size_t i = 0; i < 3; ++i) {
      fins_rad_[i] = std::clamp(fins_rad_[i], fins_rad[i] - half_rad, fins_rad[i] + half_rad);
    }
    fins_rad = fins_rad_;
  }

 private:
  Vector3 fins_rad_{};
  bool begun_ = false;
};

}  // namespace

std::unique_ptr<Effect> make_fin_backlash() { return std::make_unique<FinBacklash>(); }

}  // namespace navcal::sim
