// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "sim/effects/effect.h"
#include "sim/effects/instrument_noise.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kArrivalJitter{.name = "arrival_jitter",
                                           .equation = "arrival += Exp(mean)",
                                           .parameters = {{"compass_mean_s", 0.005, 0, 1},
                                                          {"imu_mean_s", 0.005, 0, 1},
                                                          {"gps_mean_s", 0.005, 0, 1},
                                                          {"motor_mean_s", 0.005, 0, 1}},
                                           .manoeuvre = TellingManoeuvre::none(),
                                           .place = EffectPlace::lines};

/// The host takes frames late, by exponential delays.
class ArrivalJitter final : public EffectOf<ArrivalJitter, kArrivalJitter> {
 public:
  void reseed(std::uint64_t seed) override { noise_.reseed(seed); }
  void line(Instrument of, double, Transmission& way) override {
    way.late_s -= p_[static_cast<std::size_t>(of)] * std::log1p(-noise_[of].uniform(0, 1));
  }

 private:
  InstrumentNoise noise_;
};

}  // namespace

std::unique_ptr<Effect> make_arrival_jitter() { return std::make_unique<ArrivalJitter>(); }

}  // namespace navcal::sim
