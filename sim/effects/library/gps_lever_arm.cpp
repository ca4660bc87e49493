// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGpsLeverArm{.name = "gps_lever_arm",
                                         .equation = "p += R l, v += R (w x l)",
                                         .parameters = {{"x_m", 0.45, -10, 10}, {"y_m", 0.45, -10, 10}},
                                         .manoeuvre = "turn on the spot at the surface",
                                         .confounders = {"gps_latency"},
                                         .vector = 2};

/// The antenna is off the origin by l = (x, y, 0), in body axes.
class GpsLeverArm final : public EffectOf<GpsLeverArm, kGpsLeverArm> {
 public:
  void antenna(const Instant& now, AntennaMotion& motion) override {
    const Matrix3 R = R_world_from_body(now.state.euler_rad);
    const Vector3 arm_m{p_[0], p_[1], 0};
    add_scaled(motion.position_m, 1, R * arm_m);
    add_scaled(motion.velocity_m_s, 1, R * cross(now.state.rate_rad_s, arm_m));
  }
};

}  // namespace

std::unique_ptr<Effect> make_gps_lever_arm() { return std::make_unique<GpsLeverArm>(); }

}  // namespace navcal::sim
