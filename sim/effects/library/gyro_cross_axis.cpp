// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 8> kGyroCrossAxisParameters{{{"ax_from_y", 0.03, -0.5, 0.5},
                                                                   {"ax_from_z", 0.03, -0.5, 0.5},
                                                                   {"az_from_x", 0.03, -0.5, 0.5},
                                                                   {"az_from_y", 0.03, -0.5, 0.5},
                                                                   {"by_from_x", 0.03, -0.5, 0.5},
                                                                   {"by_from_z", 0.03, -0.5, 0.5},
                                                                   {"bz_from_x", 0.03, -0.5, 0.5},
                                                                   {"bz_from_y", 0.03, -0.5, 0.5}}};

constexpr std::array<std::string_view, 3> kGyroCrossAxisConfounders{"compass_misalignment", "tilt_offset",
                                                                    "gyro_g_sensitivity"};

constexpr EffectDescription kGyroCrossAxis{.name = "gyro_cross_axis",
                                           .equation = "w_i += k w_j",
                                           .parameters = kGyroCrossAxisParameters,
                                           .manoeuvre = "turn level, then turn pitched up",
                                           .confounders = kGyroCrossAxisConfounders};

/// Each gyro feels the rates about the two other axes.
class GyroCrossAxis final : public EffectOf<GyroCrossAxis, 8> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kGyroCrossAxis; }
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
