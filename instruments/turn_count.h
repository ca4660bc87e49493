// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

namespace navcal::instruments {

/// Angle that a vehicle has turned, to either side, from consecutive headings. Steps below kStep_rad are noise
/// until they add up.
class TurnCount {
 public:
  void add(double heading_rad) {
    if (!counted_rad_) counted_rad_ = heading_rad;
    const double step_rad = std::remainder(heading_rad - *counted_rad_, 2 * std::numbers::pi);
    if (std::abs(step_rad) < kStep_rad) return;
    turned_rad_ += std::abs(step_rad);
    counted_rad_ = heading_rad;
  }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }

 private:
  static constexpr double kStep_rad = 0.1;

  std::optional<double> counted_rad_;  ///< up to here
  double turned_rad_ = 0;
};

}  // namespace navcal::instruments
