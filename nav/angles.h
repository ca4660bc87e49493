#pragma once

#include <cmath>
#include <numbers>

namespace navcal::nav {

/// -pi..pi.
[[nodiscard]] inline double wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * std::numbers::pi); }

/// 0..2 pi, the end excluded.
[[nodiscard]] inline double as_heading(double angle_rad) {
  const double angle = wrapped(angle_rad);
  const double heading = angle < 0 ? angle + 2 * std::numbers::pi : angle;
  return heading < 2 * std::numbers::pi ? heading : 0;  // a tiny negative angle rounds up to the whole turn
}

}  // namespace navcal::nav
