// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "sim/effects/effect.h"
#include "sim/effects/instrument_noise.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kStalls{.name = "stalls",
                                    .equation = "at random instants, so many a minute",
                                    .parameters = {{"duration_s", 0.5, 0, 60}, {"per_minute", 2, 0, 60}},
                                    .manoeuvre = TellingManoeuvre::none(),
                                    .place = EffectPlace::lines};

/// The host takes nothing from a line for a while, then all at once; each line on its own.
class Stalls final : public EffectOf<Stalls, kStalls> {
 public:
  void reseed(std::uint64_t seed) override { noise_.reseed(seed); }
  void line(Instrument of, double time_s, Transmission& way) override {
    if (p_[0] <= 0 || p_[1] <= 0) return;
    double& next_s = next_s_[static_cast<std::size_t>(of)];
    const auto pause_s = [&] { return -60 / p_[1] * std::log1p(-noise_[of].uniform(0, 1)); };
    if (next_s < 0) next_s = time_s + pause_s();
    while (time_s >= next_s + p_[0]) next_s += p_[0] + pause_s();
    if (time_s >= next_s) way.held_until_s = std::max(way.held_until_s, next_s + p_[0]);
  }

 private:
  InstrumentNoise noise_;
  std::array<double, kInstruments> next_s_{-1, -1, -1, -1};
};

}  // namespace

std::unique_ptr<Effect> make_stalls() { return std::make_unique<Stalls>(); }

}  // namespace navcal::sim
