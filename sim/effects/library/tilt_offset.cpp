// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 2> kTiltOffsetParameters{
    {{"roll_deg", 1, -45, 45}, {"pitch_deg", 1, -45, 45}}};

constexpr std::array<std::string_view, 2> kTiltOffsetConfounders{"accel_bias", "compass_misalignment"};

constexpr EffectDescription kTiltOffset{.name = "tilt_offset",
                                        .equation = "tilt += o",
                                        .parameters = kTiltOffsetParameters,
                                        .manoeuvre = "pitch up and down by the same angle",
                                        .confounders = kTiltOffsetConfounders};

/// The inclinometer is mounted askew.
class TiltOffset final : public EffectOf<TiltOffset, 2> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kTiltOffset; }
  void tilt_said(const Instant&, Tilt& tilt) override {
    tilt.roll_rad += p_[0] * base::kRadiansPerDegree;
    tilt.pitch_rad += p_[1] * base::kRadiansPerDegree;
  }
};

}  // namespace

std::unique_ptr<Effect> make_tilt_offset() { return std::make_unique<TiltOffset>(); }

}  // namespace navcal::sim
