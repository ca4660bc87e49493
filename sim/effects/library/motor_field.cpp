// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kMotorField{
    .name = "motor_field",
    .equation = "m += k I",
    .parameters = {{"x_uT_per_A", 1, -50, 50}, {"y_uT_per_A", 1, -50, 50}, {"z_uT_per_A", 1, -50, 50}},
    .manoeuvre = "step the motor current on a constant heading",
    .confounders = {"hard_iron", "adc_droop"},
    .vector = 3};

/// The motor's supply makes a field of its own.
class MotorField final : public EffectOf<MotorField, kMotorField> {
 public:
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    add_scaled(field_body_uT, now.state.motor_current_A, vector());
  }
};

}  // namespace

std::unique_ptr<Effect> make_motor_field() { return std::make_unique<MotorField>(); }

}  // namespace navcal::sim
