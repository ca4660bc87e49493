#include "instruments/clock_model.h"

#include <algorithm>
#include <cmath>

namespace navcal::instruments {
namespace {

constexpr double kNs = 1e9;
constexpr double kPeriodPrior = 300e-6;       // one sigma: the card's rate can be off by 200 ppm (ICD section 3)
constexpr double kFrequencyWalkPrior = 1e-6;  // per sqrt(s); then learnt from how well predictions hold
constexpr double kFrequencyWalkLeast =
    1e-6;  // assumed even of a quiet crystal: an optimistic error bar is worse than a wide one
constexpr double kFrequencyWalkMost = 20e-6;  // a ceramic resonator warming up
constexpr double kWalkGain = 0.03;            // per block
constexpr double kSurpriseLimit = 25;         // in variances: one stall must not open the filter
constexpr double kSurpriseExpected = 0.9;     // a little under 1, so that doubt widens the error bars
constexpr double kPhaseWalk_s = 2e-6;         // per sqrt(s)
constexpr double kJitterPrior_s = 1e-3;
constexpr double kJitterPriorWeight = 0.5;    // blocks
constexpr double kJitterMemory = 30;          // blocks
constexpr double kMeasurementFloor_s = 5e-6;  // what a scheduler's wake-up varies even on an idle machine
constexpr double kStampFloor_s = 5e-6;        // what no model of the delays can know of their least value
constexpr double kGate = 5;                   // sigmas by which a whole block may be late before it is left out
constexpr int kRejectedBlocksToReset = 4;
constexpr int kResetsToConfuse = 3;
constexpr std::uint64_t kObservationsToLock = 8;

/// Expected (median - minimum) of n exponential delays of mean 1: the difference of two order statistics.
double median_above_minimum(int n) {
  double sum = 0;
  for (int i = 1; i < (n + 1) / 2; ++i) sum += 1.0 / (n - i);
  return sum;
}

double square(double x) { return x * x; }

}  // namespace

ClockModel::ClockModel(double nominal_period_s)
    : nominal_s_(nominal_period_s),
      period_s_(nominal_period_s),
      jitter_s_(kJitterPrior_s),
      walk_(kFrequencyWalkPrior) {
  var_period_ = square(kPeriodPrior * nominal_s_);
}

void ClockModel::begin(std::int64_t index, std::int64_t observed_ns) {
  origin_ns_ = observed_ns;
  index_ = index;
  phase_s_ = -jitter_s_;
  var_phase_ = square(doubt() * jitter_s_);
  cov_ = 0;
  var_period_ = std::max(var_period_, square(kPeriodPrior * nominal_s_) * 0.01);
  in_block_ = 0;
  block_size_ = 1;
  rejected_blocks_ = 0;
}

void ClockModel::advance_to(std::int64_t index) {
  const auto n = static_cast<double>(index - index_);
  const double dt_s = n * nominal_s_;
  phase_s_ += n * period_s_;
  // Random walk of the frequency, integrated once for the phase (period = nominal * (1 + frequency error)).
  const double walk = square(walk_) * dt_s;
  var_phase_ += 2 * n * cov_ + n * n * var_period_ + walk * dt_s * dt_s / 3 + square(kPhaseWalk_s) * dt_s;
  cov_ += n * var_period_ + walk * dt_s / 2 * nominal_s_;
  var_period_ += walk * square(nominal_s_);
  index_ = index;
}

TimeEstimate ClockModel::update(std::int64_t index, std::int64_t observed_ns) {
  ++observations_;
  if (observations_ == 1) {
    begin(index, observed_ns);
  } else {
    advance_to(index);
  }
  const double observed_s = static_cast<double>(observed_ns - origin_ns_) / kNs;
  const double residual_s = observed_s - phase_s_;
  residuals_[static_cast<std::size_t>(in_block_++)] = residual_s;
  // A frame that comes earlier than the model allows is news at once; late ones wait for the block to end.
  const bool early = residual_s < -3 * std::sqrt(var_phase_);
  if (in_block_ == block_size_ || early) close_block();

  const double now_s = std::min(phase_s_, observed_s);
  return {origin_ns_ + std::llround(now_s * kNs), std::llround(sigma_s() * kNs)};
}

void ClockModel::close_block() {
  const auto* const first = residuals_.data();
  const double earliest_s = *std::min_element(first, first + in_block_);
  const double expected_s = jitter_s_ / in_block_;
  const double variance = square(doubt() * expected_s) + square(kMeasurementFloor_s);
  const double residual_s = earliest_s - expected_s;
  const double gate_s = kGate * std::sqrt(var_phase_ + variance);
  if (residual_s > gate_s && rejected_blocks_ + 1 < kRejectedBlocksToReset) {
    // All of the block was held up somewhere; the device's clock did not stop for that. Unless the period is
    // wrong: each such block makes it less believed, so that a bad start cannot shut the truth out.
    ++rejected_blocks_;
    var_period_ = std::max(var_period_, std::min(4 * var_period_, square(kPeriodPrior * nominal_s_)));
  } else if (residual_s > gate_s) {
    phase_s_ += residual_s;  // it stays late: the device paused
    var_phase_ = variance + square(jitter_s_);
    cov_ = 0;
    var_period_ = std::max(var_period_, square(kPeriodPrior * nominal_s_));
    rejected_blocks_ = 0;
    count_reset();
  } else {
    if (in_block_ == kMaxBlock) resets_without_fit_ = 0;
    learn_jitter();
    correct(residual_s, variance);
    rejected_blocks_ = 0;
  }
  in_block_ = 0;
  block_size_ = std::min(2 * block_size_, kMaxBlock);
}

void ClockModel::correct(double residual_s, double variance_s2) {
  const double total = var_phase_ + variance_s2;
  // Predictions that miss by more than they claim mean that the clock wanders more than was assumed.
  const double surprise = std::min(square(residual_s) / total, kSurpriseLimit) - kSurpriseExpected;
  walk_ = std::clamp(walk_ * std::exp(kWalkGain * surprise), kFrequencyWalkLeast, kFrequencyWalkMost);
  const double gain_phase = var_phase_ / total;
  const double gain_period = cov_ / total;
  phase_s_ += gain_phase * residual_s;
  period_s_ += gain_period * residual_s;
  var_period_ -= gain_period * cov_;
  cov_ *= 1 - gain_phase;
  var_phase_ *= 1 - gain_phase;
}

// As long as few blocks have told what the mean delay is, it may well be several times what is believed.
double ClockModel::doubt() const { return 1 + 4 / (1 + jitter_weight_); }

void ClockModel::learn_jitter() {
  if (in_block_ < 4) return;
  // Residuals are all relative to the model as of this block, advanced frame by frame: their differences are
  // delays.
  auto sorted = residuals_;
  auto* const middle = sorted.data() + (in_block_ + 1) / 2 - 1;
  std::nth_element(sorted.data(), middle, sorted.data() + in_block_);
  const double earliest_s = *std::min_element(sorted.data(), sorted.data() + in_block_);
  const double jitter_s = (*middle - earliest_s) / median_above_minimum(in_block_);
  if (jitter_weight_ <= 0) jitter_weight_ = kJitterPriorWeight;
  jitter_weight_ = std::min(jitter_weight_ + 1, kJitterMemory);
  jitter_s_ += (jitter_s - jitter_s_) / jitter_weight_;
}

std::int64_t ClockModel::predict_ns(std::int64_t index) const {
  const double time_s = phase_s_ + static_cast<double>(index - index_) * period_s_;
  return origin_ns_ + std::llround(time_s * kNs);
}

double ClockModel::sigma_s() const { return std::sqrt(var_phase_ + square(kStampFloor_s)); }

void ClockModel::count_reset() {
  ++resets_;
  ++resets_without_fit_;
}

bool ClockModel::confused() const { return resets_without_fit_ >= kResetsToConfuse; }

void ClockModel::reset_phase() {
  observations_ = 0;
  count_reset();
}

void ClockModel::reset_period(double period_s) {
  nominal_s_ = period_s_ = period_s;
  // Found by averaging a few arrivals: good to some per cent of a period over the frames averaged.
  var_period_ = square(0.01 * period_s);
  reset_phase();
  resets_without_fit_ = 0;
}

ClockState ClockModel::state() const {
  return {.locked = observations_ >= kObservationsToLock,
          .period_s = period_s_,
          .skew_ppm = (period_s_ / nominal_s_ - 1) * 1e6,
          .skew_std_ppm = std::sqrt(var_period_) / nominal_s_ * 1e6,
          .jitter_s = jitter_s_,
          .resets = resets_};
}

}  // namespace navcal::instruments
