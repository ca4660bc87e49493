// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGyroGSensitivity{.name = "gyro_g_sensitivity",
                                              .equation = "w_i += G_i . f",
                                              .parameters = {{"ax_x_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"ax_y_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"ax_z_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"az_x_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"az_y_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"az_z_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"by_x_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"by_y_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"by_z_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"bz_x_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"bz_y_deg_per_s_per_g", 0.6, -50, 50},
                                                             {"bz_z_deg_per_s_per_g", 0.6, -50, 50}},
                                              .manoeuvre = "hold a pitch without turning",
                                              .confounders = {"tilt_offset", "gyro_cross_axis"},
                                              .vector = 3};

/// Each gyro feels the specific force, too.
class GyroGSensitivity final : public EffectOf<GyroGSensitivity, kGyroGSensitivity> {
 public:
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    const Vector3& force = now.state.specific_force_m_s2;
    for (std::size_t i = 0; i < rate_rad_s.size(); ++i) {
      const Vector3 g = vector(3 * i);
      rate_rad_s[i] +=
          (g[0] * force[0] + g[1] * force[1] + g[2] * force[2]) * base::kRadiansPerDegree / kGravity_m_s2;
    }
  }
};

}  // namespace

std::unique_ptr<Effect> make_gyro_g_sensitivity() { return std::make_unique<GyroGSensitivity>(); }

}  // namespace navcal::sim
