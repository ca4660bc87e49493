#include "instruments/frame_clock.h"

#include <algorithm>
#include <cmath>

namespace navcal::instruments {
namespace {

constexpr double kArrivalStd_s = 1e-3;   // of a stamp by arrival: a loaded kernel's wake-up
constexpr double kAheadTolerance = 0.5;  // periods before its time that a frame may come and the phase be believed
constexpr double kPauseLimit_s = 0.5;    // later than that with nothing behind it, a counted frame means a pause
constexpr double kRateTolerance = 0.1;   // of the nominal rate
constexpr double kLeastTick = 0.4;       // of the nominal period, once a line may have babbled: less is no tick
constexpr double kSameTick = 0.25;       // intervals that differ from the median by more are none of one tick

}  // namespace

FrameClock::FrameClock(double rate_Hz, double latency_std_s)
    : periodic_(rate_Hz > 0),
      nominal_s_(periodic_ ? 1 / rate_Hz : 1.0),
      latency_std_s_(latency_std_s),
      model_(nominal_s_) {}

FrameClock::Outcome FrameClock::update(const FrameObservation& frame) {
  if (!periodic_) {
    return {{frame.observed_ns, std::llround(std::hypot(kArrivalStd_s, latency_std_s_) * 1e9)}, false};
  }
  if (model_.confused() && !on_trial_) {
    // A line that babbled, say, has been taken for the device: what is configured counts again, until the next
    // trial.
    model_.reset_period(nominal_s_);
    on_trial_ = may_babble_ = true;
    trial_frames_ = -1;
  }
  const std::int64_t index = next_index(frame);
  sequence_ = frame.sequence;
  if (index == index_ && !model_.empty()) {
    ++repeated_;
    return {{model_.predict_ns(index), std::llround(model_.sigma_s() * 1e9)}, true};
  }
  index_ = index;
  check_period(frame.observed_ns);
  TimeEstimate time = model_.update(index, frame.observed_ns);
  time.std_ns = std::llround(std::hypot(static_cast<double>(time.std_ns), latency_std_s_ * 1e9));
  return {time, false};
}

std::int64_t FrameClock::next_index(const FrameObservation& frame) {
  if (model_.empty()) return index_ + 1;
  const double late_s = static_cast<double>(frame.observed_ns - model_.predict_ns(index_ + 1)) * 1e-9;
  const double late_periods = late_s / model_.period_s();
  const bool counted = frame.sequence && sequence_;
  return counted ? by_sequence(frame, late_periods) : by_time(frame, late_periods);
}

std::int64_t FrameClock::by_sequence(const FrameObservation& frame, double late_periods) {
  const auto step = static_cast<std::uint8_t>(*frame.sequence - *sequence_);
  // The counter wraps: add the whole turns that the elapsed time makes likely.
  const double elapsed = late_periods + 1;
  const double turns = std::max(0.0, std::round((elapsed - step) / 256));
  const double counted = step + 256 * turns;
  if (counted < 0.5) return index_;
  const bool ahead = counted > elapsed + kAheadTolerance;
  const double behind_s = (elapsed - counted) * model_.period_s();
  const bool paused = behind_s > kPauseLimit_s && !frame.backlog;
  if (ahead || paused) {
    model_
        .reset_phase();  // the device began anew, or stood still: its counter says nothing about the time between
    return index_ + 1;
  }
  lost_ += static_cast<std::uint64_t>(counted) - 1;
  return index_ + static_cast<std::int64_t>(counted);
}

std::int64_t FrameClock::by_time(const FrameObservation& frame, double late_periods) {
  if (late_periods * model_.period_s() > kPauseLimit_s && late_periods > 2 && !frame.backlog) {
    // Longer than any stall of ours: silence of the device. How many it would have sent nobody knows.
    model_.reset_phase();
    guessed_lost_ = 0;
    return index_ + 1;
  }
  if (late_periods < -kAheadTolerance) {
    // Too early by the model: the frames thought lost were only late. Take them back and find the phase again.
    lost_ -= static_cast<std::uint64_t>(
        std::min(guessed_lost_, static_cast<std::int64_t>(std::llround(-late_periods))));
    guessed_lost_ = 0;
    model_.reset_phase();
    return index_ + 1;
  }
  const double margin = 3 * model_.sigma_s() / model_.period_s();
  const auto missing =
      frame.backlog ? 0 : static_cast<std::int64_t>(std::max(0.0, std::floor(late_periods + margin)));
  guessed_lost_ = missing;
  lost_ += static_cast<std::uint64_t>(missing);
  return index_ + 1 + missing;
}

void FrameClock::check_period(std::int64_t observed_ns) {
  if (!on_trial_) return;
  const bool first = trial_frames_ < 0;
  const double passed_s = static_cast<double>(observed_ns - trial_last_ns_) * 1e-9;
  if (!first && may_babble_ && passed_s < kLeastTick * nominal_s_) return;
  if (!first) {
    // Without a counter the index itself rests on the period in question: there frames are counted as they came.
    const auto ticks = sequence_ ? static_cast<double>(index_ - trial_last_index_) : 1.0;
    trial_s_[static_cast<std::size_t>(trial_frames_)] = passed_s / ticks;
  }
  trial_last_ns_ = observed_ns;
  trial_last_index_ = index_;
  if (++trial_frames_ == kTrialFrames) judge_period();
}

void FrameClock::judge_period() {
  trial_frames_ = 0;
  auto* const middle = trial_s_.data() + kTrialFrames / 2;
  std::nth_element(trial_s_.begin(), middle, trial_s_.end());
  const double median_s = *middle;
  // The mean is the better estimate, of those that are no lost frame and no pause.
  double sum_s = 0;
  int count = 0;
  for (const double tick_s : trial_s_) {
    if (std::abs(tick_s - median_s) > kSameTick * median_s) continue;
    sum_s += tick_s;
    ++count;
  }
  const double mean_s = sum_s / count;
  if (std::abs(mean_s / model_.period_s() - 1) > kRateTolerance && mean_s > 0) {
    model_.reset_period(mean_s);
  } else {
    on_trial_ = false;
  }
}

}  // namespace navcal::instruments
