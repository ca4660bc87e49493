// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kTiltSlosh{.name = "tilt_slosh",
                                       .equation = "roll -= k a_y/g, pitch += k a_x/g, before the fluid's lag",
                                       .parameters = {{"gain", 0.3, -0.15, 2}},
                                       .manoeuvre = "turn at one rate and two speeds"};

/// The inclinometer's fluid sees gravity less a share of the vehicle's acceleration.
class TiltSlosh final : public EffectOf<TiltSlosh, kTiltSlosh> {
 public:
  void tilt_seen(const Instant& now, Tilt& tilt) override {
    const Vector3 acceleration = now.acceleration_m_s2();
    tilt.roll_rad -= p_[0] * acceleration[1] / kGravity_m_s2;
    tilt.pitch_rad += p_[0] * acceleration[0] / kGravity_m_s2;
  }
};

}  // namespace

std::unique_ptr<Effect> make_tilt_slosh() { return std::make_unique<TiltSlosh>(); }

}  // namespace navcal::sim
