// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/library/library.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGpsLatency = described("gps_latency", "p(t - tau), v(t - tau)", {{"tau_s", 1, 0, 10}},
                                                    "run straight at the surface at two speeds",
                                                    {.confounders = {"gps_lever_arm"}, .kind = EffectKind::lag});
/// Position and velocity are older than the second that the message states.
struct GpsLatency final : EffectOf<GpsLatency, kGpsLatency> {
  void delays(Delays& more) override { more.gps_s += p_[0]; }
};

constexpr EffectDescription kGpsLeverArm =
    described("gps_lever_arm", "p += R l, v += R (w x l)", {{"x_m", 0.45, -10, 10}, {"y_m", 0.45, -10, 10}},
              "turn on the spot at the surface", {.confounders = {"gps_latency"}, .vector = 2});
/// The antenna is off the origin by l = (x, y, 0), in body axes.
struct GpsLeverArm final : EffectOf<GpsLeverArm, kGpsLeverArm> {
  void antenna(const Instant& now, AntennaMotion& motion) override {
    const Matrix3 R = R_world_from_body(now.state.euler_rad);
    const Vector3 arm_m{p_[0], p_[1], 0};
    add_scaled(motion.position_m, 1, R * arm_m);
    add_scaled(motion.velocity_m_s, 1, R * cross(now.state.rate_rad_s, arm_m));
  }
};

}  // namespace

std::span<const EffectEntry> effects_of_receiver() { return entries_of<GpsLatency, GpsLeverArm>(); }

}  // namespace navcal::sim
