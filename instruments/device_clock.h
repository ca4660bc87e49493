// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "instruments/clock_model.h"
#include "instruments/clock_state.h"
#include "instruments/frame_observation.h"

namespace navcal::instruments {

/// Times of validity of a stream whose frames state the time of the device's own clock (MIP reference time,
/// VectorNav TimeStartup).
///
/// Model: arrival = offset + (1 + skew) * device time + delay, with delay >= 0. ClockModel fits offset and skew;
/// its ticks are whole nominal periods of the device's clock, and the remainder is added afterwards. The frames
/// say themselves which tick they are, so frames at uneven intervals, pauses and other rates need no search. Lost
/// frames are counted in the device's time: a gap of whole periods between frames of one period.
class DeviceClock {
 public:
  /// `nominal_s`: period of the pacing frames; 0: none is known.
  explicit DeviceClock(double nominal_s);

  struct Outcome {
    TimeEstimate time;
    bool repeated = false;  ///< a pacing frame with the device time of the one before
  };
  /// `frame.device_time_ns` must be present. A step of the device's clock begins the fit anew.
  Outcome update(const FrameObservation& frame);

  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  [[nodiscard]] std::uint64_t repeated() const { return repeated_; }
  /// Time between pacing frames by our clock; 0 until enough were seen.
  [[nodiscard]] double period_s() const;
  [[nodiscard]] ClockState state() const;

 private:
  void begin(const FrameObservation& frame);
  [[nodiscard]] bool has_stepped(const FrameObservation& frame) const;
  /// False when it is a repetition.
  bool count(std::int64_t device_ns);

  double tick_s_;
  std::int64_t tick_ns_;
  std::optional<ClockModel> model_;
  std::int64_t origin_ns_ = 0;                       ///< device time of tick 0
  std::int64_t newest_ns_ = 0, newest_seen_ns_ = 0;  ///< greatest device time, and when it was observed
  std::uint64_t resets_ = 0;

  std::optional<std::int64_t> paced_ns_;  ///< device time of the newest pacing frame
  std::int64_t period_ns_ = 0;            ///< of the pacing frames, device time; 0: not known
  std::int64_t candidate_ns_ = 0;         ///< interval that may become the period
  int candidate_frames_ = 0;
  std::uint64_t missing_ = 0;  ///< thought lost; counted when the next interval is the period again
  std::uint64_t lost_ = 0, repeated_ = 0;
};

}  // namespace navcal::instruments
