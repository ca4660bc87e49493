// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "calib/archive.h"
#include "calib/readings.h"

namespace navcal::calib {

/// A magnetic heading at its time.
struct TimedHeading {
  double time_s = 0;
  double time_std_s = 0;
  double heading_rad = 0;
  void archive(Archive& archive) { archive(time_s, time_std_s, heading_rad); }
};

/// A heading and a reference of the same instant.
struct HeadingPair {
  double time_s = 0;
  double heading_rad = 0;    ///< magnetic, between two readings, not wrapped
  double rate_rad_s = 0;     ///< at which the heading changes
  double reference_rad = 0;  ///< true
  double variance_rad2 = 0;  ///< of the reference
  double time_std_s = 0;     ///< of the time by which the two differ
};

/// Pairs each reference with the heading at its time, linear between the two readings around it. References wait
/// for the headings, which come later. O(1) for each reading; memory is taken once.
class ReferenceTrack {
 public:
  /// References closer together than this are left out: they say nothing new.
  static constexpr double kLeastInterval_s = 0.09;
  /// Readings further apart do not tell the heading between them.
  static constexpr double kLongestGap_s = 0.5;

  void update(const ReferenceReading& reference) {
    const bool is_good = std::isfinite(reference.time_s) && std::isfinite(reference.heading_rad) &&
                         reference.std_rad > 0 && std::isfinite(reference.std_rad);
    if (!is_good || (newest_s_ && reference.time_s < *newest_s_ + kLeastInterval_s)) return;
    newest_s_ = reference.time_s;
    if (count_ == waiting_.size()) pop();
    waiting_[(first_ + count_++) % waiting_.size()] = reference;
  }

  /// The next heading, in order of time. `use` takes a HeadingPair.
  template <class Use>
  void update(const TimedHeading& heading, Use use) {
    for (; count_ > 0 && waiting_[first_].time_s <= heading.time_s; pop()) {
      const ReferenceReading& reference = waiting_[first_];
      const double gap_s = before_ ? heading.time_s - before_->time_s : 0;
      if (!(gap_s > 0) || gap_s > kLongestGap_s || reference.time_s < before_->time_s) continue;
      const double turn_rad = std::remainder(heading.heading_rad - before_->heading_rad, 2 * kPi);
      const double share = (reference.time_s - before_->time_s) / gap_s;
      const double time_std_s =
          std::hypot(reference.time_std_s, std::max(heading.time_std_s, before_->time_std_s));
      use(HeadingPair{reference.time_s, before_->heading_rad + share * turn_rad, turn_rad / gap_s,
                      reference.heading_rad, reference.std_rad * reference.std_rad, time_std_s});
    }
    before_ = heading;
  }
  void archive(Archive& archive) {
    archive(waiting_, first_, count_, newest_s_, before_);
    if (first_ >= waiting_.size() || count_ > waiting_.size()) first_ = count_ = 0;
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;

  void pop() {
    first_ = (first_ + 1) % waiting_.size();
    --count_;
  }

  std::array<ReferenceReading, 256> waiting_{};  ///< a ring
  std::size_t first_ = 0, count_ = 0;
  std::optional<double> newest_s_;
  std::optional<TimedHeading> before_;
};

}  // namespace navcal::calib
