#pragma once

#include <array>
#include <cstdint>

namespace navcal::instruments {

/// What the model of a device's own clock says of itself; shown in HEALTH.
struct ClockState {
  bool locked = false;  ///< enough was seen to stamp by the model rather than by arrival
  double period_s = 0;  ///< estimated time between frames
  double skew_ppm = 0;  ///< of the device's clock against ours: positive when its frames come too slowly
  double skew_std_ppm = 0;
  double jitter_s = 0;  ///< mean delay of arrivals behind the envelope
  std::uint64_t resets = 0;
};

/// A time in nanoseconds with one standard deviation.
struct TimeEstimate {
  std::int64_t time_ns = 0;
  std::int64_t std_ns = 0;
};

/// Model: frame k was measured at phase + k * period; it is observed at that time plus a delay d >= 0.
/// The delay is noise of the host, never negative, so the truth is the lower envelope of the observations. A
/// Kalman filter with the states phase and period is fed with the earliest observation of each block of frames,
/// less what the earliest of n exponential delays is expected to be late (mean delay / n). docs/timing.md derives
/// it. Value machine: no clock inside, bounded memory, O(1) per frame.
class ClockModel {
 public:
  /// `nominal_period_s` > 0.
  explicit ClockModel(double nominal_period_s);

  /// Observation of frame `index` (increasing). Returns the estimate of when it was measured, never later than
  /// observed: a frame cannot arrive before it was sent.
  TimeEstimate update(std::int64_t index, std::int64_t observed_ns);

  /// Predicted time of frame `index`; meaningful once something was observed.
  [[nodiscard]] std::int64_t predict_ns(std::int64_t index) const;
  [[nodiscard]] double sigma_s() const;  ///< one standard deviation of a prediction for the newest frame
  [[nodiscard]] double period_s() const { return period_s_; }
  [[nodiscard]] bool empty() const { return observations_ == 0; }
  /// The phase was lost again and again, and nothing has fitted in between: the period itself must be wrong.
  [[nodiscard]] bool confused() const;
  [[nodiscard]] ClockState state() const;

  /// The device paused or began anew: forget the phase, keep the period.
  void reset_phase();
  /// The device does not run at the period it was said to.
  void reset_period(double period_s);

 private:
  static constexpr int kMaxBlock = 16;

  void begin(std::int64_t index, std::int64_t observed_ns);
  void advance_to(std::int64_t index);
  void close_block();
  void count_reset();
  void correct(double residual_s, double variance_s2);
  void learn_jitter();
  [[nodiscard]] double doubt() const;

  double nominal_s_;
  std::int64_t origin_ns_ = 0;  ///< integer part of the phase, so that doubles keep nanoseconds for days
  std::int64_t index_ = 0;      ///< frame to which phase_s_ belongs
  double phase_s_ = 0;          ///< time of frame index_, relative to origin_ns_
  double period_s_;
  double var_phase_ = 0, cov_ = 0, var_period_ = 0;  ///< covariance of (phase, period)
  double jitter_s_;
  double walk_;  ///< of the frequency, relative, per sqrt(s)
  double jitter_weight_ = 0;
  std::array<double, kMaxBlock> residuals_{};  ///< of the open block
  int in_block_ = 0;
  int block_size_ = 1;
  int rejected_blocks_ = 0;
  int resets_without_fit_ = 0;
  std::uint64_t observations_ = 0;
  std::uint64_t resets_ = 0;
};

}  // namespace navcal::instruments
