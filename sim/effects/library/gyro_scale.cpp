// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGyroScale{
    .name = "gyro_scale",
    .equation = "w += k w",
    .parameters = {{"scale_ax", 0.03, -0.9, 1},
                   {"scale_az", 0.03, -0.9, 1},
                   {"scale_by", 0.03, -0.9, 1},
                   {"scale_bz", 0.03, -0.9, 1}},
    .manoeuvre = "turn two full revolutions one way",
    .confounders = {"fin_gain", "imu_latency", "compass_lag", "gyro_nonlinearity"}};

/// Each gyro's scale is off.
class GyroScale final : public EffectOf<GyroScale, kGyroScale> {
 public:
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i) rate_rad_s[i] += p_[i] * now.state.rate_rad_s[kGyroAxes[i]];
  }
};

}  // namespace

std::unique_ptr<Effect> make_gyro_scale() { return std::make_unique<GyroScale>(); }

}  // namespace navcal::sim
