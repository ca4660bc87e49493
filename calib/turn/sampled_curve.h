// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>

#include "calib/archive.h"

namespace navcal::calib {

/// Model: between samples a quantity is a cubic with the slopes of the parabolas through three neighbours, so its
/// integral over an interval h is the trapezoid with the end correction -h^2/12 (slope(end) - slope(begin)).
/// Holds the newest samples only; their times increase. Any units.
template <int Size>
class SampledCurve {
 public:
  using Value = Eigen::Matrix<double, Size, 1>;
  static constexpr std::uint32_t kCapacity = 128;

  void clear() { count_ = 0; }
  [[nodiscard]] std::uint32_t size() const { return count_; }
  [[nodiscard]] double time_s(std::uint32_t i) const { return times_[place(i)]; }
  [[nodiscard]] const Value& value(std::uint32_t i) const { return values_[place(i)]; }

  void drop_oldest() {
    first_ = (first_ + 1) % kCapacity;
    --count_;
  }
  /// The oldest gives way when there is no room.
  void add(double time_s, const Value& value) {
    if (count_ == kCapacity) drop_oldest();
    times_[place(count_)] = time_s;
    values_[place(count_)] = value;
    ++count_;
  }

  /// First sample at `time_s` or later; size() when there is none.
  [[nodiscard]] std::uint32_t find(double time_s) const {
    std::uint32_t i = 0;
    while (i < count_ && this->time_s(i) < time_s) ++i;
    return i;
  }
  /// True when no later sample can change the curve up to `time_s`.
  [[nodiscard]] bool settled(double time_s) const { return count_ >= 3 && find(time_s) + 1 < count_; }

  struct Point {
    Value value, slope;
  };
  /// Value and slope at `time_s`, from the first to the last of at least three samples.
  [[nodiscard]] Point at(double time_s) const {
    const std::uint32_t end = std::min(std::max(find(time_s), 1U), count_ - 1);
    const std::uint32_t begin = end - 1;
    const double h = this->time_s(end) - this->time_s(begin);
    const double u = (time_s - this->time_s(begin)) / h;
    const Value rise = value(end) - value(begin);
    const Value first = h * slope(begin), second = h * slope(end);
    const Value quadratic = 3 * rise - 2 * first - second, cubic = first + second - 2 * rise;
    return {value(begin) + u * (first + u * (quadratic + u * cubic)),
            (first + u * (2 * quadratic + u * 3 * cubic)) / h};
  }

  /// Drops what the curve from `time_s` on does not need.
  void forget_before(double time_s) {
    while (count_ > 3 && this->time_s(2) <= time_s) drop_oldest();
  }

  void archive(Archive& archive) {
    archive(count_);
    if (!archive.saving()) first_ = 0;
    if (count_ > kCapacity) count_ = 0;  // damaged
    for (std::uint32_t i = 0; i < count_; ++i) archive(times_[place(i)], values_[place(i)]);
  }

 private:
  [[nodiscard]] std::uint32_t place(std::uint32_t i) const { return (first_ + i) % kCapacity; }
  [[nodiscard]] Value slope(std::uint32_t i) const {
    const std::uint32_t middle = std::min(std::max(i, 1U), count_ - 2);
    const double before = time_s(middle) - time_s(middle - 1), after = time_s(middle + 1) - time_s(middle);
    const Value rising = (value(middle) - value(middle - 1)) / before;
    const Value curvature = ((value(middle + 1) - value(middle)) / after - rising) / (before + after);
    return rising + curvature * (2 * time_s(i) - time_s(middle - 1) - time_s(middle));
  }

  std::array<double, kCapacity> times_{};
  std::array<Value, kCapacity> values_;
  std::uint32_t first_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace navcal::calib
