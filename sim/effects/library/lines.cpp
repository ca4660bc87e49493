// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "sim/effects/library/library.h"
#include "sim/noise.h"

namespace navcal::sim {
namespace {

/// Effect on the lines, with random numbers of each instrument's own, so that what happens to one does not depend
/// on when another is asked.
template <class Self, const EffectDescription& kAbout>
class OnEachLine : public EffectOf<Self, kAbout> {
 public:
  void reseed(std::uint64_t seed) override {
    for (std::size_t i = 0; i < noises_.size(); ++i) noises_[i] = Noise(seed + i);
  }

 protected:
  /// The parameter of this instrument.
  [[nodiscard]] double parameter(Instrument of) const { return this->p_[static_cast<std::size_t>(of)]; }
  /// Uniform in [0, 1).
  [[nodiscard]] double random(Instrument of) { return noises_[static_cast<std::size_t>(of)].uniform(0, 1); }

 private:
  std::array<Noise, kInstruments> noises_{Noise(1), Noise(2), Noise(3), Noise(4)};
};

constexpr EffectDescription kArrivalJitter =
    described("arrival_jitter", "arrival += Exp(mean)",
              alike("compass_mean_s imu_mean_s gps_mean_s motor_mean_s", 0.005, 0, 1), TellingManoeuvre::none(),
              {.place = EffectPlace::lines});
/// The host takes frames late, by exponential delays.
struct ArrivalJitter final : OnEachLine<ArrivalJitter, kArrivalJitter> {
  void line(Instrument of, double, Transmission& way) override {
    way.late_s -= parameter(of) * std::log1p(-random(of));
  }
};

constexpr EffectDescription kClockError =
    described("clock_error", "period *= 1 + e", alike("compass_ppm imu_ppm motor_ppm", 100, -10000, 10000),
              TellingManoeuvre::none(), {.place = EffectPlace::lines});
/// The clocks of compass and cards run slow; the receiver's is that of its satellites.
struct ClockError final : EffectOf<ClockError, kClockError> {
  void clock(Instrument of, double& slow_ppm) override {
    if (of == Instrument::compass) slow_ppm += p_[0];
    if (of == Instrument::imu) slow_ppm += p_[1];
    if (of == Instrument::motor) slow_ppm += p_[2];
  }
};

constexpr EffectDescription kDroppedFrames =
    described("dropped_frames", "lost with probability p",
              alike("compass_probability imu_probability gps_probability motor_probability", 0.02, 0, 1),
              TellingManoeuvre::none(), {.place = EffectPlace::lines});
/// Frames are lost on their way to the host.
struct DroppedFrames final : OnEachLine<DroppedFrames, kDroppedFrames> {
  void line(Instrument of, double, Transmission& way) override {
    if (random(of) < parameter(of)) way.copies = 0;
  }
};

constexpr EffectDescription kNoiseLevel =
    described("noise_level", "sigma *= 1 + k", alike("compass imu gps motor", 1, 0, 100), TellingManoeuvre::none(),
              {.place = EffectPlace::lines});
/// Every instrument's noise is stronger.
struct NoiseLevel final : EffectOf<NoiseLevel, kNoiseLevel> {
  void noise(Instrument of, double& factor) override { factor *= 1 + p_[static_cast<std::size_t>(of)]; }
};

constexpr EffectDescription kRepeatedFrames =
    described("repeated_frames", "twice with probability p",
              alike("compass_probability imu_probability gps_probability motor_probability", 0.02, 0, 1),
              TellingManoeuvre::none(), {.place = EffectPlace::lines});
/// Frames come twice.
struct RepeatedFrames final : OnEachLine<RepeatedFrames, kRepeatedFrames> {
  void line(Instrument of, double, Transmission& way) override {
    if (random(of) < parameter(of)) way.copies *= 2;
  }
};

constexpr EffectDescription kStalls = described("stalls", "at random instants, so many a minute",
                                                {{"duration_s", 0.5, 0, 60}, {"per_minute", 2, 0, 60}},
                                                TellingManoeuvre::none(), {.place = EffectPlace::lines});
/// The host takes nothing from a line for a while, then all at once; each line on its own.
struct Stalls final : OnEachLine<Stalls, kStalls> {
  void line(Instrument of, double time_s, Transmission& way) override {
    if (p_[0] <= 0 || p_[1] <= 0) return;
    double& next_s = next_s_[static_cast<std::size_t>(of)];
    const auto pause_s = [&] { return -60 / p_[1] * std::log1p(-random(of)); };
    if (next_s < 0) next_s = time_s + pause_s();
    while (time_s >= next_s + p_[0]) next_s += p_[0] + pause_s();
    if (time_s >= next_s) way.held_until_s = std::max(way.held_until_s, next_s + p_[0]);
  }

 private:
  std::array<double, kInstruments> next_s_{-1, -1, -1, -1};
};

}  // namespace

std::span<const EffectEntry> effects_of_lines() {
  return entries_of<ArrivalJitter, ClockError, DroppedFrames, NoiseLevel, RepeatedFrames, Stalls>();
}

}  // namespace navcal::sim
