// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kAccelScale{
    .name = "accel_scale",
    .equation = "f += s f",
    .parameters = {{"x", 0.02, -0.9, 1}, {"y", 0.02, -0.9, 1}, {"z", 0.02, -0.9, 1}},
    .manoeuvre = "pitch through more than 30 degrees",
    .confounders = {"tilt_offset", "accel_bias", "thrust_scale"}};

/// Each accelerometer's scale is off.
class AccelScale final : public EffectOf<AccelScale, kAccelScale> {
 public:
  void accelerometers(const Instant& now, Vector3& force_m_s2) override {
    for (std::size_t i = 0; i < 3; ++i) force_m_s2[i] += p_[i] * now.state.specific_force_m_s2[i];
  }
};

}  // namespace

std::unique_ptr<Effect> make_accel_scale() { return std::make_unique<AccelScale>(); }

}  // namespace navcal::sim
