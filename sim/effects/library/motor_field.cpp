// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 3> kMotorFieldParameters{
    {{"x_uT_per_A", 1, -50, 50}, {"y_uT_per_A", 1, -50, 50}, {"z_uT_per_A", 1, -50, 50}}};

constexpr std::array<std::string_view, 2> kMotorFieldConfounders{"hard_iron", "adc_droop"};

constexpr EffectDescription kMotorField{.name = "motor_field",
                                        .equation = "m += k I",
                                        .parameters = kMotorFieldParameters,
                                        .manoeuvre = "step the motor current on a constant heading",
                                        .confounders = kMotorFieldConfounders,
                                        .vector = 3};

/// The motor's supply makes a field of its own.
class MotorField final : public EffectOf<MotorField, 3> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kMotorField; }
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    add_scaled(field_body_uT, now.state.motor_current_A, vector());
  }
};

}  // namespace

std::unique_ptr<Effect> make_motor_field() { return std::make_unique<MotorField>(); }

}  // namespace navcal::sim
