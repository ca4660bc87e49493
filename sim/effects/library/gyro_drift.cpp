// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGyroDrift{.name = "gyro_drift",
                                       .equation = "w += c t",
                                       .parameters = {{"deg_per_s2_ax", 0.001, -1, 1},
                                                      {"deg_per_s2_az", 0.001, -1, 1},
                                                      {"deg_per_s2_by", 0.001, -1, 1},
                                                      {"deg_per_s2_bz", 0.001, -1, 1}},
                                       .manoeuvre = "run long straight legs",
                                       .confounders = {"gyro_temperature"}};

/// Each gyro's zero drifts steadily from the beginning of the mission.
class GyroDrift final : public EffectOf<GyroDrift, kGyroDrift> {
 public:
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i) rate_rad_s[i] += p_[i] * base::kRadiansPerDegree * now.time_s;
  }
};

}  // namespace

std::unique_ptr<Effect> make_gyro_drift() { return std::make_unique<GyroDrift>(); }

}  // namespace navcal::sim
