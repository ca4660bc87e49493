// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 3> kAccelBiasParameters{
    {{"x_m_s2", 0.12, -20, 20}, {"y_m_s2", 0.12, -20, 20}, {"z_m_s2", 0.12, -20, 20}}};

constexpr std::array<std::string_view, 2> kAccelBiasConfounders{"tilt_offset", "accel_scale"};

constexpr EffectDescription kAccelBias{.name = "accel_bias",
                                       .equation = "f += b",
                                       .parameters = kAccelBiasParameters,
                                       .manoeuvre = "pitch through more than 30 degrees",
                                       .confounders = kAccelBiasConfounders,
                                       .vector = 3};

/// The accelerometers' zeros are off.
class AccelBias final : public EffectOf<AccelBias, 3> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kAccelBias; }
  void accelerometers(const Instant&, Vector3& force_m_s2) override { add_scaled(force_m_s2, 1, vector()); }
};

}  // namespace

std::unique_ptr<Effect> make_accel_bias() { return std::make_unique<AccelBias>(); }

}  // namespace navcal::sim
