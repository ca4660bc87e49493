// SPDX-License-Identifier: Apache-2.0
#include "instruments/frame_clock.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/enum_name.h"

namespace navcal::instruments {
namespace {

constexpr double kLateDelays = 6;       // mean delays by which the frame before may be late besides
constexpr double kLineDelay = 0.2;      // of the period: a line through few frames with longer delays is not used
constexpr double kArrivalStd_s = 1e-3;  // of a stamp by arrival where no rate is configured
// Standard deviation of a stamp by arrival when the delays are unknown. Twice that holds 95 % of exponential
// delays of 8 ms mean, those of a loaded machine.
constexpr double kUnknownStd_s = 12e-3;
constexpr double kUnknownFrames = 3;     // after so many more frames, half of that is left
constexpr double kScarce = 4;            // frames by which the delays of a short run may look too small
constexpr int kFramesWithoutTime = 32;   // by then a device has ceased to state its time
constexpr double kAheadTolerance = 0.5;  // periods: an earlier frame contradicts the phase
constexpr double kPauseLimit_s = 0.5;    // later than that with nothing behind it, a frame means a pause
// A counted frame that is later than this many periods and seconds together means a pause, too. A host that was
// late reads all that has come, and the last frame of that is less late than a period.
constexpr double kCountedPause = 1.5;
constexpr double kCountedPause_s = 0.05;
constexpr double kLostMargin_sigma = 6;
constexpr double kLostMargin = 0.002, kLostMarginMost = 0.25;  // of a period, by which a tick may be missed early
constexpr double kReachingDelay = 0.13;  // of a period: mean of delays that reach a whole one now and then
// A larger share of ticks that are counted as lost by time alone puts the period in question. The limit rises by
// the second factor times the share that was lost when the period was found.
constexpr double kLostShare = 0.15;
constexpr double kLostShareFactor = 1.5;
// Periods: a loss by time alone after a frame so late shows that the period is too short.
constexpr double kLateBeforeLoss = 0.4;
constexpr int kRegularFitsMost = 96;      // runs of 32 frames
constexpr double kTilt = 20;              // mean delays, by which changing delays can tilt the line through a run
constexpr double kShareGain = 1.0 / 24;   // per frame
constexpr double kBurstGain = 1.0 / 256;  // per frame: a stall of some seconds is no change of rhythm
constexpr double kBurstMargin = 0.5;      // periods beyond a burst's length, before frames are thought lost
constexpr double kBurstsBegin = 0.3, kBurstsEnd = 0.15;  // share of such intervals
constexpr double kLeastStep = 0.1;                       // of the period, between two times of validity
constexpr std::int64_t kLeastStep_ns = 1000;
constexpr std::uint64_t kRateFrames = 32;  // between two checks of the rate
constexpr double kRateSigmas = 5;          // beyond the tolerance, before a rate is reported
constexpr double kWholeTurn = 256;         // of the sequence number

std::int64_t ns(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

std::string_view name_of(Timing timing) {
  return base::enum_name<Timing::device>(timing,
                                         {"arrival", "searching", "periodic", "bursts", "irregular", "device"});
}

FrameClock::FrameClock(double rate_Hz, double latency_std_s)
    : nominal_s_(rate_Hz > 0 ? 1 / rate_Hz : 0), latency_std_s_(latency_std_s),
      timing_(rate_Hz > 0 ? Timing::searching : Timing::arrival), model_(rate_Hz > 0 ? nominal_s_ : 1.0) {}

std::int64_t FrameClock::arrival_std_ns() const {
  return ns(std::hypot(nominal_s_ > 0 ? kUnknownStd_s : kArrivalStd_s, latency_std_s_));
}

FrameClock::Outcome FrameClock::by_device(const FrameObservation& frame) {
  if (!device_) device_.emplace(nominal_s_);
  DeviceClock::Outcome outcome = device_->update(frame);
  timing_ = Timing::device;
  frames_without_time_ = 0;
  if (frame.paces && !outcome.repeated) {
    if (const double period_s = device_->period_s(); period_s > 0 && nominal_s_ > 0) tell_rate(period_s, 0);
    observed_ns_ = frame.observed_ns;
    return {finish(outcome.time, 0), false, std::exchange(news_, std::nullopt)};
  }
  outcome.time.std_ns = std::llround(std::hypot(static_cast<double>(outcome.time.std_ns), latency_std_s_ * 1e9));
  return {outcome.time, outcome.repeated, std::nullopt};
}

/// A single frame without a time changes nothing. After many the stream has to be searched for a rhythm.
bool FrameClock::leaves_device_clock() {
  if (++frames_without_time_ < kFramesWithoutTime) return false;
  lost_ += device_->lost();
  repeated_ += device_->repeated();
  device_.reset();
  timing_ = nominal_s_ > 0 ? Timing::searching : Timing::arrival;
  finder_.clear();
  return true;
}

FrameClock::Outcome FrameClock::update(const FrameObservation& frame) {
  if (frame.device_time_ns) return by_device(frame);
  if (device_ && !leaves_device_clock()) return {finish({frame.observed_ns, ns(kUnknownStd_s)}, 0), false, {}};
  if (any_ && is_repeated(frame)) {
    ++repeated_;
    return {{stamped_ns_, ns(kUnknownStd_s)}, true, std::nullopt};
  }
  const bool tracking = timing_ == Timing::periodic || timing_ == Timing::bursts;
  TimeEstimate time = timing_ == Timing::arrival     ? TimeEstimate{frame.observed_ns, ns(kArrivalStd_s)}
                      : tracking                     ? track(frame)
                      : timing_ == Timing::searching ? search(frame)
                                                     : by_arrival(frame);
  sequence_ = frame.sequence;
  observed_ns_ = frame.observed_ns;
  return {finish(time, tracking ? kLeastStep * model_.period_s() : 0), false, std::exchange(news_, std::nullopt)};
}

/// Adds the latency's uncertainty, and makes the times increase.
TimeEstimate FrameClock::finish(TimeEstimate time, double least_step_s) {
  double std_ns = std::hypot(static_cast<double>(time.std_ns), latency_std_s_ * 1e9);
  const std::int64_t least_ns = stamped_ns_ + std::max(kLeastStep_ns, ns(least_step_s));
  if (any_ && time.time_ns < least_ns) {
    std_ns = std::hypot(std_ns, static_cast<double>(least_ns - time.time_ns));
    time.time_ns = least_ns;
  }
  any_ = true;
  stamped_ns_ = time.time_ns;
  time.std_ns = std::llround(std_ns);
  return time;
}

/// Whether the counter has not moved. A gap long enough for whole turns of the counter is no repetition.
bool FrameClock::is_repeated(const FrameObservation& frame) const {
  if (!frame.sequence || !sequence_ || *frame.sequence != *sequence_) return false;
  const double period_s = model_known_ ? model_.period_s() : nominal_s_;
  if (period_s <= 0) return false;
  return static_cast<double>(frame.observed_ns - observed_ns_) * 1e-9 < kWholeTurn / 2 * period_s;
}

int FrameClock::counted_step(const FrameObservation& frame) const {
  if (!frame.sequence) return 0;
  return sequence_ ? std::max<int>(1, static_cast<std::uint8_t>(*frame.sequence - *sequence_)) : 1;
}

TimeEstimate FrameClock::search(const FrameObservation& frame) {
  const int step = counted_step(frame);
  const double elapsed_s = static_cast<double>(frame.observed_ns - observed_ns_) * 1e-9;
  // A counter far ahead of the elapsed time was reset by a restart of the device.
  const bool ahead = step > 4 + 4 * elapsed_s / nominal_s_;
  if (any_ && ahead) {
    finder_.clear();
  } else if (any_ && step > 1) {
    lost_ += static_cast<std::uint64_t>(step - 1);
  }
  finder_.add(frame.observed_ns, step, frame.backlog);
  const PeriodFit fit = finder_.fit();
  TimeEstimate time{frame.observed_ns, ns(kUnknownStd_s)};
  const int n = finder_.frames();
  if (fit.found && n > 5 && fit.line.delay_s < kLineDelay * fit.line.slope_s && fit.plausible_delays()) {
    const double at_s = static_cast<double>(frame.observed_ns - fit.origin_ns) * 1e-9;
    time.time_ns = fit.origin_ns + ns(std::min(at_s, fit.line.end_s));
    const double unknown_s = kUnknownStd_s * std::exp2((1 - n) / kUnknownFrames);
    time.std_ns = ns(std::hypot(unknown_s, fit.line.end_std_s * (1 + kScarce / n)));
  }
  if (finder_.full()) settle(fit);
  return time;
}

/// Decides the kind of stream, once enough frames were seen.
void FrameClock::settle(const PeriodFit& fit) {
  finder_.clear();
  if (!fit.periodic(nominal_s_)) return turn_irregular(fit.too_fast(nominal_s_) ? 1 : regular_fits_);
  if (timing_ == Timing::irregular && --fits_to_regular_ > 0) return;
  if (!confirms(fit)) return;
  model_.begin(index_, fit);
  if (!sequence_) lost_ += static_cast<std::uint64_t>(fit.lost);
  timing_ = fit.bursts() ? Timing::bursts : Timing::periodic;
  burst_share_ = fit.burst_share;
  lost_share_ = static_cast<double>(fit.lost) / (fit.frames + fit.lost);
  lost_share_most_ = kLostShare + kLostShareFactor * lost_share_;
  guessed_lost_ = 0;
  late_before_ = 0;
  model_known_ = true;
  tell_rhythm(timing_);
  frames_tracked_ = 0;
}

/// Delays that grow or shrink within a run tilt the line through it. A period that differs from the known one by
/// no more than such a tilt must be found in a second run, too.
bool FrameClock::confirms(const PeriodFit& fit) {
  const double period_s = fit.line.slope_s;
  const double change_s = std::abs(period_s - (model_known_ ? model_.period_s() : nominal_s_));
  const double before_s = std::exchange(unconfirmed_period_s_, period_s);
  return std::min(change_s, std::abs(period_s - before_s)) < kRateTolerance * period_s ||
         change_s * fit.frames > kTilt * fit.line.delay_s;
}

/// Reports a change of the rhythm, once.
void FrameClock::tell_rhythm(Timing timing) {
  if (timing == told_timing_) return;
  told_timing_ = timing;
  news_ = timing == Timing::irregular ? ClockNews::irregular
          : timing == Timing::bursts  ? ClockNews::bursts
                                      : ClockNews::regular;
}

/// Reports a rate that differs significantly from the configured one, or from the one reported last.
void FrameClock::watch_rate() {
  if (++frames_tracked_ % kRateFrames != 0 || news_ || model_.contradicted()) return;
  tell_rate(model_.period_s(), kRateSigmas * model_.period_std_s());
}

void FrameClock::tell_rate(double period_s, double doubt_s) {
  const double known_s = told_period_s_ > 0 ? told_period_s_ : nominal_s_;
  if (std::abs(period_s - known_s) < kRateTolerance * known_s + doubt_s) return;
  const bool right = std::abs(period_s - nominal_s_) < kRateTolerance * nominal_s_;
  told_period_s_ = right ? 0 : period_s;
  news_ = right ? ClockNews::rate_right : ClockNews::rate;
}

/// `fits`: number of consecutive runs of frames that must fit a clock before the stream counts as periodic
/// again.
void FrameClock::turn_irregular(int fits) {
  timing_ = Timing::irregular;
  fits_to_regular_ = fits;
  finder_.clear();
  tell_rhythm(timing_);
}

void FrameClock::search_again() {
  timing_ = Timing::searching;
  finder_.clear();
}

/// Stamps a frame by its arrival, while no clock explains the frames.
TimeEstimate FrameClock::by_arrival(const FrameObservation& frame) {
  const int step = counted_step(frame);
  if (step > 1) lost_ += static_cast<std::uint64_t>(step - 1);
  finder_.add(frame.observed_ns, step, frame.backlog);
  if (finder_.full()) settle(finder_.fit());
  return {frame.observed_ns, ns(kUnknownStd_s)};
}

TimeEstimate FrameClock::track(const FrameObservation& frame) {
  if (!model_.empty()) {
    const double late_s = static_cast<double>(frame.observed_ns - model_.predict_ns(index_ + 1)) * 1e-9;
    const double late_periods = late_s / model_.period_s();
    const bool counted = frame.sequence && sequence_;
    index_ += counted ? by_sequence(frame, late_periods) : by_time(frame, late_periods);
  } else {
    ++index_;
  }
  watch_intervals(frame);
  watch_rate();
  TimeEstimate time = model_.update(index_, frame.observed_ns, frame.backlog);
  if (timing_ == Timing::bursts) {
    // The device may have measured evenly or at the time of sending. Twice this standard deviation covers both.
    time.std_ns = ns(std::hypot(static_cast<double>(time.std_ns) * 1e-9, 0.5 * model_.delay_range_s()));
  }
  if (model_.contradicted() || lost_share_ > lost_share_most_) {
    search_again();
  } else if (model_.useless()) {
    // The frames fitted a clock at first and do not now: the next fit must hold for longer.
    regular_fits_ = std::min(2 * regular_fits_, kRegularFitsMost);
    turn_irregular(regular_fits_);
  }
  return time;
}

void FrameClock::watch_intervals(const FrameObservation& frame) {
  const double interval_s = static_cast<double>(frame.observed_ns - observed_ns_) * 1e-9;
  const double is_short = interval_s < kBurstInterval * model_.period_s() ? 1 : 0;
  burst_share_ += kBurstGain * (is_short - burst_share_);
  if (burst_share_ > kBurstsBegin) timing_ = Timing::bursts;
  if (burst_share_ < kBurstsEnd) timing_ = Timing::periodic;
  tell_rhythm(timing_);
}

std::int64_t FrameClock::by_sequence(const FrameObservation& frame, double late_periods) {
  const auto step = static_cast<std::uint8_t>(*frame.sequence - *sequence_);
  // The counter wraps: add the whole turns that the elapsed time makes likely.
  const double elapsed = late_periods + 1;
  const double turns = std::max(0.0, std::round((elapsed - step) / kWholeTurn));
  const double counted = std::max(1.0, step + kWholeTurn * turns);
  const bool ahead = counted > elapsed + kAheadTolerance;
  const double behind_s = (elapsed - counted) * model_.period_s();
  const bool paused = behind_s > kCountedPause * model_.period_s() + kCountedPause_s && !frame.backlog &&
                      timing_ != Timing::bursts;
  if (ahead || paused) {
    model_.reset_phase();  // the device restarted or stood still: its counter does not show the time in between
    return 1;
  }
  lost_ += static_cast<std::uint64_t>(counted) - 1;
  return static_cast<std::int64_t>(counted);
}

/// Margin in periods within which a frame may come before its assumed tick, when the frame before was lost.
double FrameClock::lost_margin() const {
  const double sigma = model_.sigma_s() / model_.period_s();
  // If delays reach a whole period, a frame that is late by nearly a period was only late, and nothing was
  // lost.
  const bool delays_reach = model_.mean_delay_s() > kReachingDelay * model_.period_s();
  if (delays_reach) return std::min(2 * sigma, kLostMarginMost);
  return std::min(kLostMargin + kLostMargin_sigma * sigma, kLostMarginMost);
}

std::int64_t FrameClock::by_time(const FrameObservation& frame, double late_periods) {
  if (late_periods * model_.period_s() > kPauseLimit_s && late_periods > 2 && !frame.backlog) {
    // Longer than any stall of the host: the device was silent. The number of frames that it would have sent is
    // unknown.
    model_.reset_phase();
    guessed_lost_ = 0;
    return 1;
  }
  if (late_periods < -kAheadTolerance) {
    // Too early for the model: the frames counted as lost were only late, so they are taken back.
    const std::int64_t back = std::min(guessed_lost_, static_cast<std::int64_t>(std::llround(-late_periods)));
    lost_ -= static_cast<std::uint64_t>(back);
    guessed_lost_ = 0;
    late_before_ = 0;
    if (late_periods + static_cast<double>(back) < -kAheadTolerance) model_.reset_phase();
    return 1 - back;
  }
  // All frames of a burst but the last are late by some periods.
  const double allowed = timing_ == Timing::bursts ? kBurstMargin + model_.delay_range_s() / model_.period_s() : 0;
  const auto missing =
      frame.backlog ? 0
                    : static_cast<std::int64_t>(std::max(0.0, std::floor(late_periods + lost_margin() - allowed)));
  const double usual = kLateBeforeLoss + kLateDelays * model_.mean_delay_s() / model_.period_s();
  if (missing > 0 && late_before_ > usual && allowed == 0) model_.contradict();
  late_before_ = frame.backlog ? 0 : late_periods - static_cast<double>(missing);
  guessed_lost_ = missing;
  lost_ += static_cast<std::uint64_t>(missing);
  lost_share_ += kShareGain * (static_cast<double>(missing > 0) - lost_share_);
  return 1 + missing;
}

ClockState FrameClock::state() const {
  if (timing_ == Timing::device) return device_->state();
  ClockState state = model_.state();
  state.timing = timing_;
  const bool tracking = timing_ == Timing::periodic || timing_ == Timing::bursts;
  state.locked = tracking && state.locked;
  return state;
}

}  // namespace navcal::instruments
