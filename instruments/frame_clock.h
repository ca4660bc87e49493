// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "instruments/clock_model.h"
#include "instruments/clock_state.h"
#include "instruments/device_clock.h"
#include "instruments/frame_observation.h"
#include "instruments/period_finder.h"

namespace navcal::instruments {

/// Assigns each frame to a tick of the device's clock, and estimates the time of that tick.
///
/// Lost and repeated frames are counted by the sequence number or, without one, by the device's clock. The
/// period is learnt from the frames, whatever the configuration says. Streams without a nominal rate, and those
/// that no clock explains, are stamped by arrival. Times of validity strictly increase.
///
/// Frames that carry a time of the device's own clock are stamped by DeviceClock instead: there each frame says
/// itself which tick it is.
class FrameClock {
 public:
  /// `rate_Hz` nominal, 0 for none; `latency_std_s` the uncertainty of the nominal latency.
  FrameClock(double rate_Hz, double latency_std_s);

  struct Outcome {
    TimeEstimate time;
    bool repeated = false;            ///< the frame before, once more
    std::optional<ClockNews> news{};  ///< change of the stream at this frame; reported once
  };
  Outcome update(const FrameObservation& frame);

  [[nodiscard]] std::uint64_t lost() const { return lost_ + (device_ ? device_->lost() : 0); }
  [[nodiscard]] std::uint64_t repeated() const { return repeated_ + (device_ ? device_->repeated() : 0); }
  [[nodiscard]] ClockState state() const;
  /// Standard deviation of a time that follows from the arrival alone, with the uncertainty of the latency.
  [[nodiscard]] std::int64_t arrival_std_ns() const;

 private:
  Outcome by_device(const FrameObservation& frame);
  bool leaves_device_clock();
  TimeEstimate search(const FrameObservation& frame);
  TimeEstimate track(const FrameObservation& frame);
  TimeEstimate by_arrival(const FrameObservation& frame);
  void settle(const PeriodFit& fit);
  bool confirms(const PeriodFit& fit);
  void search_again();
  void turn_irregular(int fits);
  /// Ticks since the frame before, in `track`.
  std::int64_t by_sequence(const FrameObservation& frame, double late_periods);
  std::int64_t by_time(const FrameObservation& frame, double late_periods);
  [[nodiscard]] double lost_margin() const;
  [[nodiscard]] bool is_repeated(const FrameObservation& frame) const;
  [[nodiscard]] int counted_step(const FrameObservation& frame) const;
  void watch_intervals(const FrameObservation& frame);
  void watch_rate();
  void tell_rate(double period_s, double doubt_s);
  void tell_rhythm(Timing timing);
  TimeEstimate finish(TimeEstimate time, double least_step_s);

  double nominal_s_;  ///< 0: none
  double latency_std_s_;
  Timing timing_;
  ClockModel model_;
  PeriodFinder finder_;
  std::optional<DeviceClock> device_;  ///< once a frame has stated its time
  int frames_without_time_ = 0;
  std::int64_t index_ = 0;
  std::int64_t guessed_lost_ = 0;  ///< frames thought lost by time alone, until the next frame confirms it
  std::optional<std::uint8_t> sequence_;
  std::int64_t observed_ns_ = 0;  ///< of the frame before
  std::int64_t stamped_ns_ = 0;   ///< its time of validity
  bool any_ = false;
  std::optional<ClockNews> news_;  ///< not reported yet
  Timing told_timing_ = Timing::periodic;
  double told_period_s_ = 0;         ///< 0: none but the configured one
  bool model_known_ = false;         ///< the model has been tracking before
  double unconfirmed_period_s_ = 0;  ///< of the run before, in `search`
  std::uint64_t frames_tracked_ = 0;
  int regular_fits_ = 3;  ///< runs of frames in a row that make an irregular stream a regular one
  int fits_to_regular_ = 0;
  double late_before_ = 0;  ///< periods by which the frame before was late
  double lost_share_most_ = 1;
  double lost_share_ = 0;   ///< of the last ticks, those thought lost by time alone
  double burst_share_ = 0;  ///< of the last intervals, those much shorter than the period
  std::uint64_t lost_ = 0, repeated_ = 0;
};

}  // namespace navcal::instruments
