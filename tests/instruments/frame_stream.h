// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "instruments/frame_clock.h"

namespace navcal::instruments {

/// A stream of frames with the times at which they were measured.
struct StreamFrame {
  double true_s = 0;
  FrameObservation observation;
};

/// An instrument that runs off its nominal rate, seen by a host that is late. Times in seconds.
struct StreamOptions {
  double nominal_Hz = 10;
  double factor = 1;       ///< rate over nominal rate
  double wander = 0.5e-6;  ///< of the frequency, per sqrt(s)
  double jitter_s = 2e-3;  ///< mean of the exponential delays
  double stall_s = 30e-3;
  double stall_share = 0.01;
  double lost_share = 0.01;
  bool counted = false;  ///< with sequence numbers
};

/// The host wakes up late after each frame, and reads all that has come by then.
inline std::vector<StreamFrame> read_by_host(const std::vector<StreamFrame>& sent) {
  auto frames = sent;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    auto& before = frames[i - 1].observation;
    auto& now = frames[i].observation;
    if (static_cast<double>(before.observed_ns) * 1e-9 <= frames[i].true_s) continue;
    before.backlog = true;
    now.observed_ns = before.observed_ns;
  }
  return frames;
}

inline std::vector<StreamFrame> make_stream(const StreamOptions& options, unsigned seed, int ticks) {
  std::mt19937_64 random(seed);
  std::exponential_distribution<double> exponential;
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  const double period_s = 1 / (options.nominal_Hz * options.factor);
  double frequency = 0;
  double time_s = 1000 + uniform(random);
  std::vector<StreamFrame> frames;
  for (int k = 0; k < ticks; ++k) {
    const double delay_s =
        exponential(random) * options.jitter_s + (uniform(random) < options.stall_share ? options.stall_s : 0.0);
    StreamFrame frame{time_s, {.observed_ns = std::llround((time_s + delay_s) * 1e9)}};
    if (options.counted) frame.observation.sequence = static_cast<std::uint8_t>(k);
    if (uniform(random) >= options.lost_share) frames.push_back(frame);
    frequency += options.wander * std::sqrt(period_s) * normal(random);
    time_s += period_s * (1 + frequency);
  }
  return read_by_host(frames);
}

/// Errors of the stamps of a frame clock.
struct StreamScore {
  double sum_s2 = 0, arrival_s2 = 0, claimed_s2 = 0;
  long covered = 0, count = 0;  ///< within two of the claimed standard deviations

  void add(const StreamFrame& frame, const TimeEstimate& time) {
    const double error_s = static_cast<double>(time.time_ns) * 1e-9 - frame.true_s;
    const double late_s = static_cast<double>(frame.observation.observed_ns) * 1e-9 - frame.true_s;
    const double claimed_s = static_cast<double>(time.std_ns) * 1e-9;
    sum_s2 += error_s * error_s;
    arrival_s2 += late_s * late_s;
    claimed_s2 += claimed_s * claimed_s;
    covered += std::abs(error_s) <= 2 * claimed_s ? 1 : 0;
    ++count;
  }
  void add(const StreamScore& other) {
    sum_s2 += other.sum_s2;
    arrival_s2 += other.arrival_s2;
    claimed_s2 += other.claimed_s2;
    covered += other.covered;
    count += other.count;
  }
  [[nodiscard]] double rms_s() const { return std::sqrt(sum_s2 / static_cast<double>(count)); }
  [[nodiscard]] double claimed_rms_s() const { return std::sqrt(claimed_s2 / static_cast<double>(count)); }
  [[nodiscard]] double arrival_rms_s() const { return std::sqrt(arrival_s2 / static_cast<double>(count)); }
  [[nodiscard]] double ratio() const { return rms_s() / arrival_rms_s(); }
  [[nodiscard]] double coverage() const { return static_cast<double>(covered) / static_cast<double>(count); }
};

/// Parts of a stream: its first frames, those in which the clock is being learnt, and the rest.
struct StreamScores {
  static constexpr int kFirst = 24, kLearning = 256;

  StreamScore first, learning, steady;
  bool backwards = false;  ///< a stamp was not after the one before

  void run(FrameClock& clock, const std::vector<StreamFrame>& frames) {
    int n = 0;
    std::optional<std::int64_t> before_ns;
    for (const StreamFrame& frame : frames) {
      const auto outcome = clock.update(frame.observation);
      if (outcome.repeated) continue;
      backwards = backwards || (before_ns && outcome.time.time_ns <= *before_ns);
      before_ns = outcome.time.time_ns;
      (n < kFirst ? first : n < kLearning ? learning : steady).add(frame, outcome.time);
      ++n;
    }
  }
};

}  // namespace navcal::instruments
