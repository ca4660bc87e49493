#include <numbers>

#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

constexpr std::array<EffectParameter, 4> kParameters{{{"deg_per_s2_ax", 0.001, -1, 1},
                                                      {"deg_per_s2_az", 0.001, -1, 1},
                                                      {"deg_per_s2_by", 0.001, -1, 1},
                                                      {"deg_per_s2_bz", 0.001, -1, 1}}};

constexpr EffectDescription kDescription{.name = "gyro_drift", .equation = "w += c t", .parameters = kParameters};

/// Each gyro's zero drifts steadily from the beginning of the mission.
class GyroDrift final : public EffectOf<GyroDrift, 4> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kDescription; }
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i) rate_rad_s[i] += p_[i] * kRadians * now.time_s;
  }
};

}  // namespace

std::unique_ptr<Effect> make_gyro_drift() { return std::make_unique<GyroDrift>(); }

}  // namespace navcal::sim
