// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kAccelBias{
    .name = "accel_bias",
    .equation = "f += b",
    .parameters = {{"x_m_s2", 0.12, -20, 20}, {"y_m_s2", 0.12, -20, 20}, {"z_m_s2", 0.12, -20, 20}},
    .manoeuvre = "pitch through more than 30 degrees",
    .confounders = {"tilt_offset", "accel_scale"},
    .vector = 3};

/// The accelerometers' zeros are off.
class AccelBias final : public EffectOf<AccelBias, kAccelBias> {
 public:
  void accelerometers(const Instant&, Vector3& force_m_s2) override { add_scaled(force_m_s2, 1, vector()); }
};

}  // namespace

std::unique_ptr<Effect> make_accel_bias() { return std::make_unique<AccelBias>(); }

}  // namespace navcal::sim
