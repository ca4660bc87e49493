// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

/// Angles are in radians, headings clockwise from north.
namespace navcal::base {

inline constexpr double kTurn_rad = 2 * std::numbers::pi;
inline constexpr double kDegreesPerRadian = 180 / std::numbers::pi;
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

/// The same direction as an angle from -pi to pi.
[[nodiscard]] inline double wrapped(double angle_rad) { return std::remainder(angle_rad, kTurn_rad); }

/// The same direction as an angle from 0 to 2 pi, the end excluded. An angle already there comes back bit for bit.
[[nodiscard]] inline double positive_angle(double angle_rad) {
  const double once = angle_rad - kTurn_rad * std::floor(angle_rad / kTurn_rad);
  return once < kTurn_rad ? once : 0.0;
}

/// The same, by way of -pi to pi: exact for large angles.
[[nodiscard]] inline double as_heading(double angle_rad) {
  const double angle = wrapped(angle_rad);
  const double heading = angle < 0 ? angle + kTurn_rad : angle;
  return heading < kTurn_rad ? heading : 0;  // a tiny negative angle rounds up to the whole turn
}

}  // namespace navcal::base
