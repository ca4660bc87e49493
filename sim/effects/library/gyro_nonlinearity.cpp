// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGyroNonlinearity{.name = "gyro_nonlinearity",
                                              .equation = "w += k w |w|",
                                              .parameters = {{"s_per_deg_ax", 0.0008, -0.01, 0.01},
                                                             {"s_per_deg_az", 0.0008, -0.01, 0.01},
                                                             {"s_per_deg_by", 0.0008, -0.01, 0.01},
                                                             {"s_per_deg_bz", 0.0008, -0.01, 0.01}},
                                              .manoeuvre = "turn at two very different rates",
                                              .confounders = {"gyro_scale"}};

/// Each gyro's scale grows with the rate.
class GyroNonlinearity final : public EffectOf<GyroNonlinearity, kGyroNonlinearity> {
 public:
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const double rate = now.state.rate_rad_s[kGyroAxes[i]];
      rate_rad_s[i] += p_[i] / base::kRadiansPerDegree * rate * std::abs(rate);
    }
  }
};

}  // namespace

std::unique_ptr<Effect> make_gyro_nonlinearity() { return std::make_unique<GyroNonlinearity>(); }

}  // namespace navcal::sim
