// SPDX-License-Identifier: Apache-2.0
#include "instruments/device_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace navcal::instruments {
namespace {

constexpr double kTick_s = 0.01;  // where no rate is configured
/// A frame so much earlier than the device's clock says was not early: the clock was set.
constexpr std::int64_t kAheadOfTime_ns = 100'000'000;
/// No host is later than this without a backlog: the device's clock stood still or began anew.
constexpr std::int64_t kBehindTime_ns = 2'000'000'000;
/// A smaller step back is a frame of another set that was delayed in the device.
constexpr std::int64_t kOutOfOrder_ns = 1'000'000'000;
constexpr double kCrystals = 1e-3;  // relative difference of two clocks, at most
constexpr double kSameInterval = 0.05;
constexpr int kFramesToPeriod = 8;

bool is_near(std::int64_t a_ns, std::int64_t b_ns) {
  return std::abs(static_cast<double>(a_ns - b_ns)) <= kSameInterval * static_cast<double>(b_ns);
}

}  // namespace

DeviceClock::DeviceClock(double nominal_s)
    : tick_s_(nominal_s > 0 ? nominal_s : kTick_s), tick_ns_(std::llround(tick_s_ * 1e9)) {
  tick_s_ = static_cast<double>(tick_ns_) * 1e-9;
}

void DeviceClock::begin(const FrameObservation& frame) {
  if (model_) resets_ += 1 + model_->state().resets;
  model_.emplace(tick_s_, ClockModel::kCrystal, true);
  origin_ns_ = newest_ns_ = *frame.device_time_ns;
  newest_seen_ns_ = frame.observed_ns;
  paced_ns_.reset();
  missing_ = 0;
}

bool DeviceClock::has_stepped(const FrameObservation& frame) const {
  const std::int64_t by_device_ns = *frame.device_time_ns - newest_ns_;
  const std::int64_t by_arrival_ns = frame.observed_ns - newest_seen_ns_;
  const std::int64_t drift_ns = std::llround(kCrystals * std::abs(static_cast<double>(by_arrival_ns)));
  if (by_device_ns < -kOutOfOrder_ns) return true;
  if (by_device_ns > by_arrival_ns + kAheadOfTime_ns + drift_ns) return true;
  return !frame.backlog && by_arrival_ns > std::max<std::int64_t>(by_device_ns, 0) + kBehindTime_ns + drift_ns;
}

bool DeviceClock::count(std::int64_t device_ns) {
  if (paced_ns_ && *paced_ns_ == device_ns) {
    ++repeated_;
    return false;
  }
  const std::int64_t step_ns = paced_ns_ ? device_ns - *paced_ns_ : 0;
  paced_ns_ = device_ns;
  if (step_ns <= 0) return true;
  if (period_ns_ > 0 && is_near(step_ns, period_ns_)) {
    lost_ += missing_;
    missing_ = 0;
  } else if (period_ns_ > 0) {
    const std::int64_t periods = (step_ns + period_ns_ / 2) / period_ns_;
    const bool whole = periods > 1 && std::abs(static_cast<double>(step_ns - periods * period_ns_)) <
                                          kSameInterval * static_cast<double>(period_ns_);
    missing_ = whole ? missing_ + static_cast<std::uint64_t>(periods - 1) : 0;
  }
  if (candidate_ns_ == 0 || !is_near(step_ns, candidate_ns_)) {
    candidate_ns_ = step_ns;
    candidate_frames_ = 0;
  }
  if (++candidate_frames_ >= kFramesToPeriod && !is_near(candidate_ns_, std::max<std::int64_t>(period_ns_, 1))) {
    period_ns_ = candidate_ns_;
    missing_ = 0;  // the device has another rate now
  }
  return true;
}

DeviceClock::Outcome DeviceClock::update(const FrameObservation& frame) {
  const std::int64_t device_ns = *frame.device_time_ns;
  if (!model_ || has_stepped(frame) || model_->contradicted()) begin(frame);
  Outcome outcome;
  outcome.repeated = frame.paces && !count(device_ns);
  const std::int64_t since_ns = device_ns - origin_ns_;
  const auto index =
      static_cast<std::int64_t>(std::floor(static_cast<double>(since_ns) / static_cast<double>(tick_ns_) + 0.5));
  const std::int64_t beyond_ns = since_ns - index * tick_ns_;
  if (device_ns >= newest_ns_ && !outcome.repeated) {
    outcome.time = model_->update(index, frame.observed_ns - beyond_ns, frame.backlog);
    newest_ns_ = device_ns;
    newest_seen_ns_ = frame.observed_ns;
  } else {
    outcome.time = {model_->predict_ns(index), std::llround(model_->sigma_s() * 1e9)};
  }
  outcome.time.time_ns = std::min(outcome.time.time_ns + beyond_ns, frame.observed_ns);
  return outcome;
}

double DeviceClock::period_s() const {
  if (period_ns_ == 0 || !model_) return 0;
  return static_cast<double>(period_ns_) * 1e-9 * model_->period_s() / tick_s_;
}

ClockState DeviceClock::state() const {
  ClockState state = model_ ? model_->state() : ClockState{};
  state.timing = Timing::device;
  state.period_s = period_ns_ > 0 ? period_s() : tick_s_;
  state.resets += resets_;
  return state;
}

}  // namespace navcal::instruments
