// SPDX-License-Identifier: Apache-2.0
#include "instruments/clock_model.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "instruments/period_finder.h"

namespace navcal::instruments {
namespace {

constexpr double kNs = 1e9;
constexpr double kFrequencyWalkPrior = 1e-6;    // per sqrt(s); then learnt from how well predictions hold
constexpr double kFrequencyWalkLeast = 0.5e-6;  // assumed even of a quiet crystal
constexpr double kFrequencyWalkMost = 20e-6;    // a ceramic resonator warming up
constexpr double kWalkGain = 0.03;              // per block
constexpr double kMisfitLimit = 25;             // in variances: one stall must not open the filter
constexpr double kMisfitExpected = 1.0;
constexpr double kMisfitGain = 0.05;          // per block
constexpr double kMisfitIgnored = 1.5;        // what chance alone makes of the mean over recent blocks
constexpr double kPhaseWalk_s = 1e-6;         // per sqrt(s)
constexpr double kMeasurementFloor_s = 2e-6;  // what a scheduler's wake-up varies even on an idle machine
constexpr double kStampFloor_s = 2e-6;        // uncertainty of the least delay in any model
constexpr double kEarly = 3;                  // sigmas before its time: news at once
constexpr double kTooEarly = 6;               // sigmas: no noise, the model is wrong
constexpr double kTooEarlyDelay = 0.5;        // of the mean delay, likewise
constexpr double kGate = 5;                   // sigmas by which a whole block may be late before it is left out
constexpr double kLateExpected = 5;           // (mean delay / n) by which n frames may all be late
constexpr int kLateFrames = 3;                // fewer may be late together by a stall
constexpr double kSoftEdgeShare = 1.2;        // standard deviation, in distances of the middle from the edge
constexpr double kSoftMeasurement = 0.3;      // likewise, of the earliest of a block
constexpr double kFitCaution = 1.3;           // on the errors of a line through few frames
constexpr double kFitBlocks = 2;              // weight of such a line
constexpr double kAstray = 0.5;               // of the mean delay: a block that misses by more went astray,
constexpr double kAstrayLeast = 0.004;        // if that is more than this share of a period
constexpr double kAstrayGain = 0.1;           // per block
constexpr double kAstrayMost = 0.5;           // of the recent blocks
constexpr int kRejectedBlocksToReset = 4;
constexpr int kContradictionsToGiveUp = 4;
constexpr std::uint64_t kObservationsToLock = 8;

double square(double x) { return x * x; }

}  // namespace

ClockModel::ClockModel(double nominal_period_s, double period_std, bool is_sharp)
    : is_sharp_(is_sharp), nominal_s_(nominal_period_s), period_prior_s_(period_std * nominal_period_s),
      period_s_(nominal_period_s), walk_(kFrequencyWalkPrior) {
  var_period_ = square(period_prior_s_);
}

void ClockModel::begin_at(std::int64_t index, std::int64_t observed_ns) {
  origin_ns_ = observed_ns;
  index_ = index;
  phase_s_ = -delays_.mean_s();
  var_phase_ = square(doubt() * delays_.mean_s());
  cov_ = 0;
  var_period_ = std::max(var_period_, square(period_prior_s_) * 0.01);
  in_block_ = 0;
  block_size_ = 1;
  rejected_blocks_ = 0;
  held_late_s_ = 0;
}

void ClockModel::begin(std::int64_t index, const PeriodFit& fit) {
  origin_ns_ = fit.origin_ns;
  index_ = index;
  phase_s_ = fit.line.end_s;
  period_s_ = fit.line.slope_s;
  period_prior_s_ = kCrystal * period_s_;
  const double span_s = (fit.frames + fit.lost) * period_s_;
  var_phase_ = square(kFitCaution * fit.line.end_std_s) + square(kMeasurementFloor_s);
  var_period_ = square(kFitCaution * fit.line.slope_std_s) + square(kMeasurementFloor_s * period_s_ / span_s);
  cov_ = kEndSlopeCorrelation * std::sqrt(var_phase_ * var_period_);
  delays_.begin(fit.line.delay_s, fit.range_s, kFitBlocks);
  walk_ = kFrequencyWalkPrior;
  misfit_ = 1;
  astray_ = 0;
  in_block_ = 0;
  block_size_ = kMaxBlock;
  rejected_blocks_ = contradictions_ = 0;
  held_late_s_ = 0;
  observations_ = kObservationsToLock;
}

void ClockModel::advance_to(std::int64_t index) {
  const auto n = static_cast<double>(index - index_);
  const double dt_s = n * period_s_;
  phase_s_ += dt_s;
  // Random walk of the frequency, integrated once for the phase (period = nominal * (1 + frequency error)).
  const double walk = square(walk_) * dt_s;
  var_phase_ += 2 * n * cov_ + n * n * var_period_ + walk * dt_s * dt_s / 3 + square(kPhaseWalk_s) * dt_s;
  cov_ += n * var_period_ + walk * dt_s / 2 * period_s_;
  var_period_ += walk * square(period_s_);
  index_ = index;
}

TimeEstimate ClockModel::update(std::int64_t index, std::int64_t observed_ns, bool held_up) {
  ++observations_;
  if (observations_ == 1) {
    begin_at(index, observed_ns);
  } else {
    advance_to(index);
  }
  const double observed_s = static_cast<double>(observed_ns - origin_ns_) / kNs;
  const double residual_s = observed_s - phase_s_;
  const bool early = residual_s < -kEarly * std::sqrt(var_phase_ + square(kSoftMeasurement * soft_edge_s()));
  if (early || !held_up) {
    if (early) take_early(residual_s);
    earliest_s_ = in_block_ == 0 ? residual_s : std::min(earliest_s_, residual_s);
    residuals_[static_cast<std::size_t>(in_block_++)] = residual_s;
    // A frame earlier than the model allows closes the block at once; late ones wait for the block to end.
    if (in_block_ == block_size_ || early) close_block();
  }
  const double now_s = std::min(phase_s_ + soft_edge_s(), observed_s);
  return {origin_ns_ + std::llround(now_s * kNs), std::llround(sigma_s() * kNs)};
}

/// No frame arrives early: a frame that is far too early shows an error of the model, at least as large as the
/// frame is early.
void ClockModel::take_early(double residual_s) {
  const double allowed_s = std::hypot(kTooEarly * std::sqrt(var_phase_ * std::max(1.0, misfit_)),
                                      std::max(kTooEarlyDelay * delays_.mean_s(), soft_edge_s()));
  if (-residual_s < allowed_s) return;
  const double opened = 1 + square(residual_s) / var_phase_;
  var_phase_ *= opened;
  cov_ *= std::sqrt(opened);
  ++contradictions_;
}

void ClockModel::close_block() {
  const double expected_s = delays_.mean_s() / in_block_;
  const double variance =
      square(doubt() * expected_s) + square(kMeasurementFloor_s) + square(kSoftMeasurement * soft_edge_s());
  const double residual_s = earliest_s_ - expected_s;
  const double gate_s = kGate * std::sqrt((var_phase_ + variance) * std::max(1.0, misfit_));
  const bool astray = std::abs(residual_s) > std::max(kAstray * delays_.mean_s(), kAstrayLeast * period_s_);
  const double share = std::max(0.25, static_cast<double>(in_block_) / kMaxBlock);
  astray_ += kAstrayGain * share * (static_cast<double>(astray) - astray_);
  if (residual_s > gate_s) {
    reject_block(residual_s, variance);
  } else {
    if (in_block_ == kMaxBlock) contradictions_ = std::max(0, contradictions_ - 1);
    if (in_block_ >= 4) delays_.learn(std::span(residuals_).first(static_cast<std::size_t>(in_block_)));
    correct(residual_s, variance);
    rejected_blocks_ = 0;
    held_late_s_ = 0;
  }
  in_block_ = 0;
  block_size_ = std::min(2 * block_size_, kMaxBlock);
}

/// The whole block was delayed, or the device paused, or the period is wrong.
void ClockModel::reject_block(double residual_s, double variance_s2) {
  held_late_s_ = residual_s;
  contradictions_ += 2;
  if (++rejected_blocks_ < kRejectedBlocksToReset) {
    // Each such block widens the variance of the period, so that a wrong start value cannot exclude the true
    // one.
    var_period_ = std::max(var_period_, std::min(4 * var_period_, square(period_prior_s_)));
    return;
  }
  phase_s_ += residual_s;  // it stays late: the device paused
  var_phase_ = variance_s2 + square(delays_.mean_s());
  cov_ = 0;
  var_period_ = std::max(var_period_, square(period_prior_s_));
  rejected_blocks_ = 0;
  held_late_s_ = 0;
  ++resets_;
}

void ClockModel::correct(double residual_s, double variance_s2) {
  const double total = var_phase_ + variance_s2;
  // Prediction errors larger than their standard deviation show that the frequency wanders more than was
  // assumed.
  const double misfit = std::min(square(residual_s) / total, kMisfitLimit);
  walk_ = std::clamp(walk_ * std::exp(kWalkGain * (misfit - kMisfitExpected)), kFrequencyWalkLeast,
                     kFrequencyWalkMost);
  misfit_ += kMisfitGain * (misfit - misfit_);
  const double gain_phase = var_phase_ / total;
  const double gain_period = cov_ / total;
  phase_s_ += gain_phase * residual_s;
  period_s_ += gain_period * residual_s;
  var_period_ -= gain_period * cov_;
  cov_ *= 1 - gain_phase;
  var_phase_ *= 1 - gain_phase;
}

// Relative standard deviation of the expected delay. While few blocks have been seen, the true mean delay may
// be several times the estimate.
double ClockModel::doubt() const { return 1 + 4 / (1 + delays_.weight()) - 0.13; }

/// Delay of the newest frames beyond what the model of the delays explains.
double ClockModel::least_late_s() const {
  const double late_s = in_block_ < kLateFrames ? 0 : earliest_s_ - kLateExpected * delays_.mean_s() / in_block_;
  return std::max({0.0, late_s, in_block_ < kLateFrames ? held_late_s_ : 0.0});
}

std::int64_t ClockModel::predict_ns(std::int64_t index) const {
  const double time_s = phase_s_ + static_cast<double>(index - index_) * period_s_;
  return origin_ns_ + std::llround(time_s * kNs);
}

double ClockModel::sigma_s() const {
  const double excess = std::max(1.0, misfit_ / kMisfitIgnored);
  return std::sqrt(var_phase_ * excess + square(kStampFloor_s) + square(kSoftEdgeShare * soft_edge_s()) +
                   square(least_late_s()));
}

double ClockModel::period_std_s() const {
  return std::sqrt(var_period_ * std::max(1.0, misfit_ / kMisfitIgnored));
}

void ClockModel::contradict() { contradictions_ = kContradictionsToGiveUp; }

bool ClockModel::useless() const { return astray_ > kAstrayMost; }

bool ClockModel::contradicted() const { return contradictions_ >= kContradictionsToGiveUp; }

void ClockModel::reset_phase() {
  observations_ = 0;
  contradictions_ += 2;
  ++resets_;
}

ClockState ClockModel::state() const {
  return {.locked = observations_ >= kObservationsToLock,
          .timing = Timing::periodic,
          .period_s = period_s_,
          .skew_ppm = (period_s_ / nominal_s_ - 1) * 1e6,
          .skew_std_ppm = period_std_s() / nominal_s_ * 1e6,
          .jitter_s = delays_.mean_s(),
          .resets = resets_};
}

}  // namespace navcal::instruments
