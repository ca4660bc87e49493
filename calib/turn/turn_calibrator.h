// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calib/archive.h"
#include "calib/judgement.h"
#include "calib/turn/turn_filter_bank.h"

namespace navcal::calib {

/// A gyro or a compass calibrated by turns (TurnFilterBank), with the headings that it has seen and its judgement.
/// The filter's covariance alone is not enough to judge by: where less than the circle was seen and the gyro is
/// not known, its scale is mixed up with the deviation, and both are believed too well (THESIS 11.3).
class TurnCalibrator {
 public:
  enum class Subject : std::uint8_t { gyro, compass };
  struct Limits {
    double scale_std = 0.03;
    double bias_std_rad_s = 0.0052;   ///< 0.3 deg/s
    double heading_std_rad = 0.0175;  ///< of the corrected heading, worst over the circle
    double chi_squared = 25;          ///< of the residuals against the noise as configured
    std::size_t sectors = 33;         ///< of 36, while the gyro is not known
    std::uint64_t readings = 50;
  };

  TurnCalibrator(Subject subject, const TurnFilter::Parameters& parameters);

  void update(const TurnStep& step);
  /// Forgets everything.
  void start(const TurnPrior& prior = TurnPrior::unknown_both());

  [[nodiscard]] const TurnFilterBank& filter() const { return filter_; }
  [[nodiscard]] bool has_estimate() const { return filter_.readings() >= limits_.readings; }
  /// Standard error of the corrected heading but for A, worst over the circle.
  [[nodiscard]] double worst_heading_std_rad() const;
  [[nodiscard]] Judgement judgement() const;
  void archive(Archive& archive);

 private:
  void judge_gyro(Judgement& judgement) const;
  void judge_compass(Judgement& judgement) const;

  Subject subject_;
  TurnFilter::Parameters parameters_;
  Limits limits_;
  TurnFilterBank filter_;
  bool gyro_known_ = false;  ///< by the prior
  HeadingHistogram rose_{};
};

}  // namespace navcal::calib
