// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kNoiseLevel{
    .name = "noise_level",
    .equation = "sigma *= 1 + k",
    .parameters = {{"compass", 1, 0, 100}, {"imu", 1, 0, 100}, {"gps", 1, 0, 100}, {"motor", 1, 0, 100}},
    .manoeuvre = TellingManoeuvre::none(),
    .place = EffectPlace::lines};

/// Every instrument's noise is stronger.
class NoiseLevel final : public EffectOf<NoiseLevel, kNoiseLevel> {
 public:
  void noise(Instrument of, double& factor) override { factor *= 1 + p_[static_cast<std::size_t>(of)]; }
};

}  // namespace

std::unique_ptr<Effect> make_noise_level() { return std::make_unique<NoiseLevel>(); }

}  // namespace navcal::sim
