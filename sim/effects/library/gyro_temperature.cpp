// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGyroTemperature{.name = "gyro_temperature",
                                             .equation = "w += c T, T above 15 C",
                                             .parameters = {{"deg_per_s_per_C_ax", 0.06, -5, 5},
                                                            {"deg_per_s_per_C_az", 0.06, -5, 5},
                                                            {"deg_per_s_per_C_by", 0.06, -5, 5},
                                                            {"deg_per_s_per_C_bz", 0.06, -5, 5}},
                                             .manoeuvre = "run once from cold and once warmed up",
                                             .confounders = {"gyro_drift"}};

/// Each gyro's zero moves as the electronics warm up.
class GyroTemperature final : public EffectOf<GyroTemperature, kGyroTemperature> {
 public:
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i)
      rate_rad_s[i] += p_[i] * base::kRadiansPerDegree * now.temperature_rise_C();
  }
};

}  // namespace

std::unique_ptr<Effect> make_gyro_temperature() { return std::make_unique<GyroTemperature>(); }

}  // namespace navcal::sim
