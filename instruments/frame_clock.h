#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "instruments/clock_model.h"

namespace navcal::instruments {

/// One frame of a periodic stream, as its time was observed.
struct FrameObservation {
  /// Monotonic time before which it must have been measured: arrival less wire time less nominal latency.
  std::int64_t observed_ns = 0;
  std::optional<std::uint8_t> sequence;  ///< the device's counter, where it has one (wraps at 256)
  bool backlog = false;                  ///< more of the stream lay behind it in the same read: the host was late
};

/// Which of the device's ticks a frame belongs to, and when that tick was: counts lost and repeated frames by the
/// sequence number, or, without one, by the device's clock. Streams without a nominal rate are stamped by arrival.
class FrameClock {
 public:
  /// `rate_Hz` nominal, 0 for none; `latency_std_s` the uncertainty of the nominal latency.
  FrameClock(double rate_Hz, double latency_std_s);

  struct Outcome {
    TimeEstimate time;
    bool repeated = false;  ///< the frame before, once more
  };
  Outcome update(const FrameObservation& frame);

  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  [[nodiscard]] std::uint64_t repeated() const { return repeated_; }
  [[nodiscard]] ClockState state() const { return model_.state(); }

 private:
  std::int64_t next_index(const FrameObservation& frame);
  std::int64_t by_sequence(const FrameObservation& frame, double late_periods);
  std::int64_t by_time(const FrameObservation& frame, double late_periods);
  void check_period(std::int64_t observed_ns);
  void judge_period();

  static constexpr int kTrialFrames = 24;  ///< after which the rate seen is held against the configured one

  bool periodic_;
  double nominal_s_;
  double latency_std_s_;
  ClockModel model_;
  std::int64_t index_ = 0;
  std::int64_t guessed_lost_ = 0;  ///< frames thought lost by time alone, until the next frame confirms it
  std::optional<std::uint8_t> sequence_;
  std::uint64_t lost_ = 0, repeated_ = 0;
  // Whether the device really runs at its nominal rate.
  std::array<double, kTrialFrames> trial_s_{};  ///< time for one tick, frame by frame
  std::int64_t trial_last_ns_ = 0;
  std::int64_t trial_last_index_ = 0;
  int trial_frames_ = -1;  ///< so many are in `trial_s_`; -1: the first is to come
  bool on_trial_ = true;
  bool may_babble_ = false;  ///< the clock was confused before
};

}  // namespace navcal::instruments
