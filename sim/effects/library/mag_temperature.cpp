// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 3> kMagTemperatureParameters{
    {{"x_uT_per_C", 0.15, -10, 10}, {"y_uT_per_C", 0.15, -10, 10}, {"z_uT_per_C", 0.15, -10, 10}}};

constexpr std::array<std::string_view, 2> kMagTemperatureConfounders{"hard_iron", "gyro_drift"};

constexpr EffectDescription kMagTemperature{.name = "mag_temperature",
                                            .equation = "m += c T, T above 15 C",
                                            .parameters = kMagTemperatureParameters,
                                            .manoeuvre = "let the electronics warm up with the motor off",
                                            .confounders = kMagTemperatureConfounders,
                                            .vector = 3};

/// The magnetometers' zeros move as the electronics warm up.
class MagTemperature final : public EffectOf<MagTemperature, 3> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kMagTemperature; }
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    add_scaled(field_body_uT, now.temperature_rise_C(), vector());
  }
};

}  // namespace

std::unique_ptr<Effect> make_mag_temperature() { return std::make_unique<MagTemperature>(); }

}  // namespace navcal::sim
