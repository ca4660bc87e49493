// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kAdcDroop{.name = "adc_droop",
                                      .equation = "every raw channel in mV: v *= 1 + k I",
                                      .parameters = {{"per_A", 0.0015, -0.1, 0.1}},
                                      .manoeuvre = "step the motor current, straight and level",
                                      .confounders = {"motor_field", "accel_vibration"}};

/// The converter's reference follows the motor's load.
class AdcDroop final : public EffectOf<AdcDroop, kAdcDroop> {
 public:
  void card_voltages(const Instant& now, CardVoltages_mV& voltages) override {
    for (double& voltage : voltages) voltage *= 1 + p_[0] * now.state.motor_current_A;
  }
};

}  // namespace

std::unique_ptr<Effect> make_adc_droop() { return std::make_unique<AdcDroop>(); }

}  // namespace navcal::sim
