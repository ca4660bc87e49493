// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kTiltOffset{.name = "tilt_offset",
                                        .equation = "tilt += o",
                                        .parameters = {{"roll_deg", 1, -45, 45}, {"pitch_deg", 1, -45, 45}},
                                        .manoeuvre = "pitch up and down by the same angle",
                                        .confounders = {"accel_bias", "compass_misalignment"}};

/// The inclinometer is mounted askew.
class TiltOffset final : public EffectOf<TiltOffset, kTiltOffset> {
 public:
  void tilt_said(const Instant&, Tilt& tilt) override {
    tilt.roll_rad += p_[0] * base::kRadiansPerDegree;
    tilt.pitch_rad += p_[1] * base::kRadiansPerDegree;
  }
};

}  // namespace

std::unique_ptr<Effect> make_tilt_offset() { return std::make_unique<TiltOffset>(); }

}  // namespace navcal::sim
