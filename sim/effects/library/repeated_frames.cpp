// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"
#include "sim/effects/instrument_noise.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kRepeatedFrames{.name = "repeated_frames",
                                            .equation = "twice with probability p",
                                            .parameters = {{"compass_probability", 0.02, 0, 1},
                                                           {"imu_probability", 0.02, 0, 1},
                                                           {"gps_probability", 0.02, 0, 1},
                                                           {"motor_probability", 0.02, 0, 1}},
                                            .manoeuvre = TellingManoeuvre::none(),
                                            .place = EffectPlace::lines};

/// Frames come twice.
class RepeatedFrames final : public EffectOf<RepeatedFrames, kRepeatedFrames> {
 public:
  void reseed(std::uint64_t seed) override { noise_.reseed(seed); }
  void line(Instrument of, double, Transmission& way) override {
    if (noise_[of].uniform(0, 1) < p_[static_cast<std::size_t>(of)]) way.copies *= 2;
  }

 private:
  InstrumentNoise noise_;
};

}  // namespace

std::unique_ptr<Effect> make_repeated_frames() { return std::make_unique<RepeatedFrames>(); }

}  // namespace navcal::sim
