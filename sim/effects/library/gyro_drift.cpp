// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 4> kGyroDriftParameters{{{"deg_per_s2_ax", 0.001, -1, 1},
                                                               {"deg_per_s2_az", 0.001, -1, 1},
                                                               {"deg_per_s2_by", 0.001, -1, 1},
                                                               {"deg_per_s2_bz", 0.001, -1, 1}}};

constexpr std::array<std::string_view, 1> kGyroDriftConfounders{"gyro_temperature"};

constexpr EffectDescription kGyroDrift{.name = "gyro_drift",
                                       .equation = "w += c t",
                                       .parameters = kGyroDriftParameters,
                                       .manoeuvre = "run long straight legs",
                                       .confounders = kGyroDriftConfounders};

/// Each gyro's zero drifts steadily from the beginning of the mission.
class GyroDrift final : public EffectOf<GyroDrift, 4> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kGyroDrift; }
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i) rate_rad_s[i] += p_[i] * base::kRadiansPerDegree * now.time_s;
  }
};

}  // namespace

std::unique_ptr<Effect> make_gyro_drift() { return std::make_unique<GyroDrift>(); }

}  // namespace navcal::sim
