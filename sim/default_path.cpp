// SPDX-License-Identifier: Apache-2.0
#include "sim/default_path.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "sim/rotation.h"

namespace navcal::sim {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kSpeed_m_s = 1.0;
constexpr double kFirstDepth_m = 0.15;
constexpr double kRollPerTurn_s = 0.065;    // the vehicle heels 3 degrees at its tightest turn
constexpr double kRudderPerTurn_s = 0.528;  // which takes 25 degrees of rudder
constexpr double kShaft_rpm = 705;

struct Leg {
  double duration_s;
  double turn_rad;
  double dive_m;
};

// The second half mirrors the first, so that the path closes.
constexpr double kHalf = std::numbers::pi;
constexpr std::array<Leg, 10> kLegs{{{20, 0, 0},
                                     {20, -2 * kHalf, 0},
                                     {12, 0, 1},
                                     {10, 0, 0},
                                     {12, kHalf, 0},
                                     {10, 0, 0},
                                     {12, 0, -1},
                                     {20, 2 * kHalf, 0},
                                     {20, 0, 0},
                                     {12, kHalf, 0}}};

/// Smooth step from 0 to 1 over the leg, with a rate that does not jump: s - sin(2 pi s)/(2 pi), and its first
/// and second derivatives.
struct Ease {
  double value, rate, rate_change;
};
Ease ease(double s) {
  return {s - std::sin(base::kTurn_rad * s) / base::kTurn_rad, 1 - std::cos(base::kTurn_rad * s),
          base::kTurn_rad * std::sin(base::kTurn_rad * s)};
}

/// Everything but the position; yaw from `yaw` at the beginning of the leg.
PathRow row_at(const Leg& leg, double into_s, double yaw) {
  const Ease e = ease(into_s / leg.duration_s);
  const double turn = leg.turn_rad * e.rate / leg.duration_s;
  const double turn_change = leg.turn_rad * e.rate_change / (leg.duration_s * leg.duration_s);
  const double sink = leg.dive_m * e.rate / leg.duration_s;
  const double sink_change = leg.dive_m * e.rate_change / (leg.duration_s * leg.duration_s);
  const double theta = -std::asin(sink / kSpeed_m_s);
  PathRow row;
  row.euler_rad = {kRollPerTurn_s * turn, theta, yaw + leg.turn_rad * e.value};
  row.velocity_body_m_s = {kSpeed_m_s, 0, 0};
  row.rate_rad_s = body_rates(row.euler_rad,
                              {kRollPerTurn_s * turn_change, -sink_change / (kSpeed_m_s * std::cos(theta)), turn});
  row.rpm = kShaft_rpm;
  // ICD section 4: the mixing of a rudder and an elevator command.
  const double rudder = kRudderPerTurn_s * turn;
  const double lift = 0.3 * theta * std::numbers::sqrt3 / 2;
  row.fins_rad = {-rudder, rudder / 2 + lift, rudder / 2 - lift};
  return row;
}

}  // namespace

std::vector<PathRow> default_path() {
  std::vector<PathRow> rows;
  PathRow row = row_at(kLegs.front(), 0, 0);
  row.position_m[2] = kFirstDepth_m;
  rows.push_back(row);
  double yaw = 0;
  for (const Leg& leg : kLegs) {
    const int steps = static_cast<int>(std::lround(leg.duration_s / kStep_s));
    for (int i = 1; i <= steps; ++i) {
      const PathRow& before = rows.back();
      row = row_at(leg, i * kStep_s, yaw);
      row.t_s = static_cast<double>(rows.size()) * kStep_s;
      const Vector3 from = R_world_from_body(before.euler_rad) * before.velocity_body_m_s;
      const Vector3 to = R_world_from_body(row.euler_rad) * row.velocity_body_m_s;
      for (std::size_t k = 0; k < 3; ++k)
        row.position_m[k] = before.position_m[k] + kStep_s * (from[k] + to[k]) / 2;
      rows.push_back(row);
    }
    yaw += leg.turn_rad;
  }
  return rows;
}

}  // namespace navcal::sim
