// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 4> kGyroTemperatureParameters{{{"deg_per_s_per_C_ax", 0.06, -5, 5},
                                                                     {"deg_per_s_per_C_az", 0.06, -5, 5},
                                                                     {"deg_per_s_per_C_by", 0.06, -5, 5},
                                                                     {"deg_per_s_per_C_bz", 0.06, -5, 5}}};

constexpr std::array<std::string_view, 1> kGyroTemperatureConfounders{"gyro_drift"};

constexpr EffectDescription kGyroTemperature{.name = "gyro_temperature",
                                             .equation = "w += c T, T above 15 C",
                                             .parameters = kGyroTemperatureParameters,
                                             .manoeuvre = "run once from cold and once warmed up",
                                             .confounders = kGyroTemperatureConfounders};

/// Each gyro's zero moves as the electronics warm up.
class GyroTemperature final : public EffectOf<GyroTemperature, 4> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kGyroTemperature; }
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i)
      rate_rad_s[i] += p_[i] * base::kRadiansPerDegree * now.temperature_rise_C();
  }
};

}  // namespace

std::unique_ptr<Effect> make_gyro_temperature() { return std::make_unique<GyroTemperature>(); }

}  // namespace navcal::sim
