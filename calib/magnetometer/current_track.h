// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "calib/archive.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Motor current over time, linear between the motor card's readings.
class CurrentTrack {
 public:
  /// Readings come in the order of their times; one without a current is left out.
  void update(const MotorReading& motor);
  /// Interpolated current in amperes; nullopt unless two readings at most kLongest_s apart enclose `time_s`.
  [[nodiscard]] std::optional<double> at(double time_s) const;
  /// Same as at(), but where that is not known yet the newest reading, if it is not older than kLongest_s.
  [[nodiscard]] std::optional<double> at_or_newest(double time_s) const;
  /// The newest reading, if it is not older than kLongest_s.
  [[nodiscard]] std::optional<double> newest(double time_s) const;
  /// Drops all readings; called when their times belong to another time scale.
  void forget() { count_ = 0; }
  void archive(Archive& archive);

 private:
  static constexpr std::size_t kKept = 64;
  static constexpr double kLongest_s = 1;
  struct Point {
    double time_s = 0, current_A = 0;
    void archive(Archive& archive) { archive(time_s, current_A); }
  };
  [[nodiscard]] const Point& back(std::size_t age) const { return points_[(next_ + 2 * kKept - 1 - age) % kKept]; }

  std::array<Point, kKept> points_{};  ///< a ring
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace navcal::calib
