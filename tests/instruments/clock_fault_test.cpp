// SPDX-License-Identifier: Apache-2.0
// What faults of a line do to the clock of a device: while they last, and above all afterwards.
#include <gtest/gtest.h>

#include "instruments/frame_clock.h"
#include "tests/instruments/clock_simulation.h"

namespace navcal::instruments {
namespace {

struct Rig {
  Rig(double rate_Hz, bool counted) : clock(rate_Hz, 0), period_s(1 / rate_Hz), with_counter(counted) {}

  /// A frame that is observed at `time_s`; returns by how much its time of validity differs.
  double frame(double observed_s) {
    FrameObservation observation;
    observation.observed_ns = std::llround(observed_s * 1e9);
    if (with_counter) observation.sequence = static_cast<std::uint8_t>(counter++);
    return static_cast<double>(clock.update(observation).time.time_ns) * 1e-9 - observed_s;
  }
  void run(double seconds) {
    for (const double end_s = time_s + seconds; time_s < end_s; time_s += period_s) frame(time_s);
  }
  /// The greatest error of the next frames.
  double worst(double seconds) {
    double worst_s = 0;
    for (const double end_s = time_s + seconds; time_s < end_s; time_s += period_s)
      worst_s = std::max(worst_s, std::abs(frame(time_s)));
    return worst_s;
  }
  /// Intact frames at ten times the rate, as a line that babbles repeats them.
  void flood(double seconds, bool counter_goes_on) {
    const unsigned before = counter;
    const double begin_s = time_s;
    for (int i = 0; i < static_cast<int>(10 * seconds / period_s); ++i) {
      frame(begin_s + 0.1 * period_s * i);
      if (!counter_goes_on && i % 40 == 39) counter = before;
    }
    counter = before + static_cast<unsigned>(seconds / period_s);
    time_s = begin_s + period_s * std::ceil(seconds / period_s);
  }

  FrameClock clock;
  double period_s;
  bool with_counter;
  double time_s = 100;
  unsigned counter = 0;
};

TEST(ClockFault, AfterAFloodTheTimesAreRightAgain) {
  for (const double rate_Hz : {1.0, 10.0, 20.0}) {
    for (const bool counted : {false, true}) {
      for (const bool goes_on : {false, true}) {
        Rig rig(rate_Hz, counted);
        rig.run(60);
        for (int i = 0; i < 3; ++i) {
          rig.flood(std::max(1.0, 3 / rate_Hz), goes_on);
          rig.run(std::max(5.0, 40 / rate_Hz));
          EXPECT_LT(rig.worst(60), 0.01 * rig.period_s) << rate_Hz << " Hz, counter " << counted << goes_on;
          EXPECT_NEAR(rig.clock.state().period_s * rate_Hz, 1, 1e-3) << rate_Hz << " Hz, counter " << counted;
        }
      }
    }
  }
}

TEST(ClockFault, AFloodAtTheVeryBeginningIsForgotten) {
  for (const bool counted : {false, true}) {
    Rig rig(10, counted);
    rig.flood(1, true);
    rig.run(30);
    EXPECT_LT(rig.worst(60), 1e-3) << counted;
    EXPECT_NEAR(rig.clock.state().period_s, 0.1, 1e-4) << counted;
  }
}

TEST(ClockFault, LostFramesAtTheBeginningAreNoSlowerDevice) {
  Rig rig(1, false);
  for (int k = 0; k < 40; ++k, rig.time_s += 1) {
    if (k % 6 != 3) rig.frame(rig.time_s);
  }
  rig.run(60);
  EXPECT_NEAR(rig.clock.state().period_s, 1, 1e-3);
  EXPECT_LT(std::abs(rig.clock.state().skew_ppm), 1000);
}

}  // namespace
}  // namespace navcal::instruments
