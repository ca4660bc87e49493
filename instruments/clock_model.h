// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "instruments/clock_state.h"
#include "instruments/delay_spread.h"

namespace navcal::instruments {

struct PeriodFit;

/// Model: frame k was measured at phase + k * period; it is observed at that time plus a delay d >= 0.
///
/// The delay is noise of the host and never negative, so the true times are the lower envelope of the
/// observations. A Kalman filter with the states phase and period processes the earliest observation of each
/// block of frames. The expected delay of the earliest of n exponential delays (mean delay / n) is subtracted
/// first. docs/timing.md derives it.
///
/// No clock inside, bounded memory, O(1) per frame.
class ClockModel {
 public:
  static constexpr double kCrystal = 300e-6;  ///< a card's rate can be off by 200 ppm (ICD section 3)

  /// `nominal_period_s` > 0, with the relative standard deviation `period_std` until begin() sets a better
  /// estimate.
  /// `is_sharp`: the frames state their times, so that none is early, whatever the shape of the delays.
  explicit ClockModel(double nominal_period_s, double period_std = kCrystal, bool is_sharp = false);

  /// Sets phase and period to those fitted to a run of frames; `index` is the newest of them.
  void begin(std::int64_t index, const PeriodFit& fit);
  /// Observation of frame `index` (not less than the one before). Returns the estimate of when it was measured,
  /// never later than observed: a frame cannot arrive before it was sent. `held_up`: known to be late.
  TimeEstimate update(std::int64_t index, std::int64_t observed_ns, bool held_up = false);

  /// Predicted time of frame `index`; meaningful once something was observed.
  [[nodiscard]] std::int64_t predict_ns(std::int64_t index) const;
  [[nodiscard]] double sigma_s() const;  ///< one standard deviation of a prediction for the newest frame
  [[nodiscard]] double period_s() const { return period_s_; }
  [[nodiscard]] double period_std_s() const;
  [[nodiscard]] double mean_delay_s() const { return delays_.mean_s(); }
  /// Mean range of the delays within a block, from the earliest to the latest.
  [[nodiscard]] double delay_range_s() const { return delays_.range_s(); }
  [[nodiscard]] bool empty() const { return observations_ == 0; }
  /// Observations contradict the model repeatedly: phase and period must be found anew.
  [[nodiscard]] bool contradicted() const;
  /// Reports an observation that contradicts the period beyond doubt.
  void contradict();
  /// Prediction errors of blocks are as large as the differences of frames within a block: no clock paces these
  /// frames.
  [[nodiscard]] bool useless() const;
  [[nodiscard]] ClockState state() const;

  /// Forgets the phase and keeps the period, after the device paused or began anew.
  void reset_phase();

 private:
  static constexpr int kMaxBlock = 16;

  void begin_at(std::int64_t index, std::int64_t observed_ns);
  void advance_to(std::int64_t index);
  void take_early(double residual_s);
  void close_block();
  void reject_block(double residual_s, double variance_s2);
  void correct(double residual_s, double variance_s2);
  [[nodiscard]] double doubt() const;
  [[nodiscard]] double soft_edge_s() const { return is_sharp_ ? 0 : delays_.soft_edge_s(); }
  [[nodiscard]] double least_late_s() const;

  bool is_sharp_;
  double nominal_s_;
  double period_prior_s_;
  std::int64_t origin_ns_ = 0;  ///< integer part of the phase, so that doubles keep nanoseconds for days
  std::int64_t index_ = 0;      ///< frame to which phase_s_ belongs
  double phase_s_ = 0;          ///< time of frame index_, relative to origin_ns_
  double period_s_;
  double var_phase_ = 0, cov_ = 0, var_period_ = 0;  ///< covariance of (phase, period)
  double walk_;                                      ///< of the frequency, relative, per sqrt(s)
  double misfit_ = 1;                                ///< normalised innovation squared, mean over recent blocks
  double held_late_s_ = 0;  ///< delay of the whole last block, if it was left out for that
  DelaySpread delays_;
  std::array<double, kMaxBlock> residuals_{};  ///< of the open block
  double earliest_s_ = 0;                      ///< of them
  int in_block_ = 0;
  int block_size_ = 1;
  int rejected_blocks_ = 0;
  double astray_ = 0;       ///< share of the recent blocks that missed by more than the frames' spread
  int contradictions_ = 0;  ///< since a whole block fitted
  std::uint64_t observations_ = 0;
  std::uint64_t resets_ = 0;
};

}  // namespace navcal::instruments
