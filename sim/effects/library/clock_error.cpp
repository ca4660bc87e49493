// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kClockError{.name = "clock_error",
                                        .equation = "period *= 1 + e",
                                        .parameters = {{"compass_ppm", 100, -10000, 10000},
                                                       {"imu_ppm", 100, -10000, 10000},
                                                       {"motor_ppm", 100, -10000, 10000}},
                                        .manoeuvre = TellingManoeuvre::none(),
                                        .place = EffectPlace::lines};

/// The clocks of compass and cards run slow; the receiver's is that of its satellites.
class ClockError final : public EffectOf<ClockError, kClockError> {
 public:
  void clock(Instrument of, double& slow_ppm) override {
    if (of == Instrument::compass) slow_ppm += p_[0];
    if (of == Instrument::imu) slow_ppm += p_[1];
    if (of == Instrument::motor) slow_ppm += p_[2];
  }
};

}  // namespace

std::unique_ptr<Effect> make_clock_error() { return std::make_unique<ClockError>(); }

}  // namespace navcal::sim
