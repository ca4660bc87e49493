// SPDX-License-Identifier: Apache-2.0
#include "instruments/janus.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rotation.h"
#include "base/vectors.h"

namespace navcal::instruments {
namespace {

/// Signs of the beams in the error velocity: 1 and 2 against 3 and 4.
constexpr std::array<double, 4> kErrorSigns{1, 1, -1, -1};

/// All four, a missing one replaced; false with more than one missing.
bool completed(const BeamValues& beams, std::array<double, 4>& all) {
  std::size_t missing = 0, missing_beam = 0;
  double error = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    all[i] = beams[i].value_or(0);
    error += kErrorSigns[i] * all[i];
    if (beams[i]) continue;
    ++missing;
    missing_beam = i;
  }
  if (missing == 1) all[missing_beam] = -kErrorSigns[missing_beam] * error;
  return missing < 2;
}

/// Direction of each beam from the head, in the instrument's axes.
Vector3 beam_direction(std::size_t beam, const JanusHead& head) {
  const double aside = (head.is_convex ? 1 : -1) * std::sin(head.beam_angle_rad);
  const double away = -std::cos(head.beam_angle_rad);
  switch (beam) {
    case 0: return {-aside, 0, away};
    case 1: return {aside, 0, away};
    case 2: return {0, aside, away};
    default: return {0, -aside, away};
  }
}

}  // namespace

std::optional<JanusVelocity> velocity_of_beams(const BeamValues& beam_m_s, const JanusHead& head) {
  std::array<double, 4> b{};
  if (!completed(beam_m_s, b)) return std::nullopt;
  const double across = 1 / (2 * std::sin(head.beam_angle_rad));
  const double along = 1 / (4 * std::cos(head.beam_angle_rad));
  const double sign = head.is_convex ? 1 : -1;
  JanusVelocity result;
  result.velocity_m_s = {sign * across * (b[0] - b[1]), sign * across * (b[3] - b[2]),
                         along * (b[0] + b[1] + b[2] + b[3])};
  const bool has_all = std::ranges::all_of(beam_m_s, [](const auto& one) { return one.has_value(); });
  if (has_all) result.error_m_s = across / std::numbers::sqrt2 * (b[0] + b[1] - b[2] - b[3]);
  return result;
}

Vector3 body_of_instrument(const Vector3& vector, const JanusHead& head) {
  // A head that looks up is turned about its forward axis by half a turn.
  const double side = head.looks_up ? -1 : 1;
  const double starboard = side * vector[0], forward = vector[1], up = side * vector[2];
  const double c = std::cos(head.alignment_rad), s = std::sin(head.alignment_rad);
  return {forward * c - starboard * s, forward * s + starboard * c, -up};
}

std::optional<double> altitude_of_beams(const BeamValues& range_m, const JanusHead& head, double pitch_rad,
                                        double roll_rad) {
  if (head.looks_up) return std::nullopt;
  const Eigen::Vector3d down = base::rotation_of({roll_rad, pitch_rad, 0}).transpose() * Eigen::Vector3d::UnitZ();
  double sum_m = 0;
  int count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!range_m[i]) continue;
    const double downwards = down.dot(base::vector_of(body_of_instrument(beam_direction(i, head), head)));
    if (downwards <= 0) return std::nullopt;
    sum_m += *range_m[i] / std::cos(head.beam_angle_rad) * downwards;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum_m / count;
}

Vector3 body_of_level(const Vector3& vector, double pitch_rad, double roll_rad) {
  const Eigen::Vector3d body = base::rotation_of({roll_rad, pitch_rad, 0}).transpose() * base::vector_of(vector);
  return {body.x(), body.y(), body.z()};
}

double euler_pitch_rad(double pendulum_pitch_rad, double roll_rad) {
  return std::atan(std::tan(pendulum_pitch_rad) * std::cos(roll_rad));
}

}  // namespace navcal::instruments
