// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"
#include "sim/effects/instrument_noise.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kDroppedFrames{.name = "dropped_frames",
                                           .equation = "lost with probability p",
                                           .parameters = {{"compass_probability", 0.02, 0, 1},
                                                          {"imu_probability", 0.02, 0, 1},
                                                          {"gps_probability", 0.02, 0, 1},
                                                          {"motor_probability", 0.02, 0, 1}},
                                           .manoeuvre = TellingManoeuvre::none(),
                                           .place = EffectPlace::lines};

/// Frames are lost on their way to the host.
class DroppedFrames final : public EffectOf<DroppedFrames, kDroppedFrames> {
 public:
  void reseed(std::uint64_t seed) override { noise_.reseed(seed); }
  void line(Instrument of, double, Transmission& way) override {
    if (noise_[of].uniform(0, 1) < p_[static_cast<std::size_t>(of)]) way.copies = 0;
  }

 private:
  InstrumentNoise noise_;
};

}  // namespace

std::unique_ptr<Effect> make_dropped_frames() { return std::make_unique<DroppedFrames>(); }

}  // namespace navcal::sim
