// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "instruments/envelope_line.h"
#include "instruments/frame_observation.h"

namespace navcal::instruments {

/// Two frames closer together than this share of the period came in a burst.
inline constexpr double kBurstInterval = 0.3;

/// Period and phase of the device's ticks, fitted to a run of frames with only a rough prior of the period.
struct PeriodFit {
  bool found = false;  ///< enough frames for a line
  EnvelopeLine line;   ///< end_s relative to origin_ns
  std::int64_t origin_ns = 0;
  int frames = 0;
  int lost = 0;         ///< ticks without a frame
  double spread_s = 0;  ///< mean absolute deviation of the residuals from their median
  double range_s = 0;   ///< the greatest of them, without stalls
  double roughness =
      0;  ///< mean |difference of neighbouring residuals| / spread: 1.4 independent, less for a walk
  double burst_share = 0;  ///< of the intervals that are much shorter than the period

  [[nodiscard]] bool bursts() const;
  /// Whether the mean delay is plausible for a host or an instrument.
  [[nodiscard]] bool plausible_delays() const;
  [[nodiscard]] bool too_fast(double nominal_s) const;
  /// Whether the frames are ticks of one clock. `nominal_s` is the configured period.
  [[nodiscard]] bool periodic(double nominal_s) const;
};

/// Finds period and phase from the newest frames alone: at the beginning, and when the clock model no longer
/// describes a device.
///
/// Without sequence numbers, the ticks to which the frames belong are found as well. Several periods are tried,
/// each with a whole number of ticks in the time observed. The one with the smallest delays wins; each lost
/// frame adds a penalty. Bounded: 32 frames, and a fit takes some microseconds.
class PeriodFinder {
 public:
  static constexpr int kFrames = kEnvelopeMost;

  void clear() { frames_ = 0; }
  /// `step`: ticks since the frame before by the device's counter; 0: no counter.
  void add(std::int64_t observed_ns, int step, bool backlog);
  [[nodiscard]] int frames() const { return frames_; }
  [[nodiscard]] bool full() const { return frames_ == kFrames; }
  [[nodiscard]] PeriodFit fit() const;

 private:
  struct Ticks {
    std::array<double, kFrames> index{};
    EnvelopeLine line;
    double score = 0;
  };
  struct Kept {
    std::array<std::size_t, kFrames> at{};
    std::size_t count = 0;
  };
  void drop_before_pause();
  [[nodiscard]] Kept kept_frames() const;
  void describe(const Ticks& ticks, PeriodFit& fit) const;
  void count_ticks(Ticks& ticks) const;
  void guess_ticks(double period_s, Ticks& ticks) const;
  void settle_ticks(Ticks& ticks) const;
  void judge(Ticks& ticks) const;
  [[nodiscard]] Ticks best_ticks() const;
  [[nodiscard]] double median_interval() const;
  [[nodiscard]] std::span<const double> times() const {
    return {time_s_.data(), static_cast<std::size_t>(frames_)};
  }

  std::int64_t origin_ns_ = 0;
  std::array<double, kFrames> time_s_{};  ///< relative to origin_ns_
  std::array<int, kFrames> step_{};
  std::array<bool, kFrames> backlog_{};
  int frames_ = 0;
};

}  // namespace navcal::instruments
