// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kMagTemperature{
    .name = "mag_temperature",
    .equation = "m += c T, T above 15 C",
    .parameters = {{"x_uT_per_C", 0.15, -10, 10}, {"y_uT_per_C", 0.15, -10, 10}, {"z_uT_per_C", 0.15, -10, 10}},
    .manoeuvre = "let the electronics warm up with the motor off",
    .confounders = {"hard_iron", "gyro_drift"},
    .vector = 3};

/// The magnetometers' zeros move as the electronics warm up.
class MagTemperature final : public EffectOf<MagTemperature, kMagTemperature> {
 public:
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    add_scaled(field_body_uT, now.temperature_rise_C(), vector());
  }
};

}  // namespace

std::unique_ptr<Effect> make_mag_temperature() { return std::make_unique<MagTemperature>(); }

}  // namespace navcal::sim
