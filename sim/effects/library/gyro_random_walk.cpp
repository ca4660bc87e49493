// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include "base/angles.h"
#include "sim/effects/effect.h"
#include "sim/noise.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGyroRandomWalk{.name = "gyro_random_walk",
                                            .equation = "w += integral of white noise",
                                            .parameters = {{"deg_per_s_per_sqrt_s_ax", 0.002, 0, 1},
                                                           {"deg_per_s_per_sqrt_s_az", 0.002, 0, 1},
                                                           {"deg_per_s_per_sqrt_s_by", 0.002, 0, 1},
                                                           {"deg_per_s_per_sqrt_s_bz", 0.002, 0, 1}},
                                            .manoeuvre = TellingManoeuvre::none(),
                                            .place = EffectPlace::lines};

/// Each gyro's zero walks at random.
class GyroRandomWalk final : public EffectOf<GyroRandomWalk, kGyroRandomWalk> {
 public:
  void reseed(std::uint64_t seed) override { noise_ = Noise(seed); }
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    const double root = std::sqrt(std::max(0.0, now.time_s - time_s_.value_or(now.time_s)));
    time_s_ = now.time_s;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      walk_rad_s_[i] += noise_.normal(p_[i] * base::kRadiansPerDegree * root);
      rate_rad_s[i] += walk_rad_s_[i];
    }
  }

 private:
  Noise noise_{1};
  std::optional<double> time_s_;
  GyroRates walk_rad_s_{};
};

}  // namespace

std::unique_ptr<Effect> make_gyro_random_walk() { return std::make_unique<GyroRandomWalk>(); }

}  // namespace navcal::sim
