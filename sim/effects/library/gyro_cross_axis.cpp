// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGyroCrossAxis{
    .name = "gyro_cross_axis",
    .equation = "w_i += k w_j",
    .parameters = {{"ax_from_y", 0.03, -0.5, 0.5},
                   {"ax_from_z", 0.03, -0.5, 0.5},
                   {"az_from_x", 0.03, -0.5, 0.5},
                   {"az_from_y", 0.03, -0.5, 0.5},
                   {"by_from_x", 0.03, -0.5, 0.5},
                   {"by_from_z", 0.03, -0.5, 0.5},
                   {"bz_from_x", 0.03, -0.5, 0.5},
                   {"bz_from_y", 0.03, -0.5, 0.5}},
    .manoeuvre = "turn level, then turn pitched up",
    .confounders = {"compass_misalignment", "tilt_offset", "gyro_g_sensitivity"}};

/// Each gyro feels the rates about the two other axes.
class GyroCrossAxis final : public EffectOf<GyroCrossAxis, kGyroCrossAxis> {
 public:
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    const double* factor = p_.data();
    for (std::size_t i = 0; i < rate_rad_s.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis != kGyroAxes[i]) rate_rad_s[i] += *factor++ * now.state.rate_rad_s[axis];
      }
    }
  }
};

}  // namespace

std::unique_ptr<Effect> make_gyro_cross_axis() { return std::make_unique<GyroCrossAxis>(); }

}  // namespace navcal::sim
