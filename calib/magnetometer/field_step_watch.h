// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "calib/archive.h"

namespace navcal::calib {

/// Model: the surprise z of a reading (FieldPredictor), its squared departure in units of the predicted variance,
/// has mean 1 while the field is the fitted one, and much more after a step. Cumulative sum (Page, Biometrika 41,
/// 1954) of min(z, ceiling) - reference: a single outlier adds at most the ceiling, a step goes on adding.
class FieldStepWatch {
 public:
  static constexpr std::uint64_t kLongest = 128;  ///< readings from onset to alarm; a slower rise is not a step

  /// True: the field may have stepped, since_onset() readings ago. `z` >= 0.
  bool update(double z) {
    sum_ += std::min(z, kCeiling) - kReference;
    ++since_onset_;
    if (!(sum_ > 0) || since_onset_ > kLongest) reset();
    return sum_ > kAlarm;
  }
  /// Readings since the sum last was zero, with the newest.
  [[nodiscard]] std::uint64_t since_onset() const { return since_onset_; }
  void reset() { *this = {}; }

  /// True when a reading is too far off to be used.
  [[nodiscard]] static bool is_off(double z) { return z > kGate; }

  void archive(Archive& archive) { archive(sum_, since_onset_); }

 private:
  static constexpr double kGate = 25;      // five standard deviations
  static constexpr double kCeiling = 12;   // so four outliers in a row are still no step
  static constexpr double kReference = 4;  // two standard deviations: tilt and accelerations make 1.5
  static constexpr double kAlarm = 60;

  double sum_ = 0;
  std::uint64_t since_onset_ = 0;
};

}  // namespace navcal::calib
