#include "gap/servo_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace navcal::gap {
namespace {

/// Variance of one report's noise and resolution; of a rudder or an elevator worked out from three, two thirds.
constexpr double kNoise_rad = 0.104 * std::numbers::pi / 180;
/// The share of it that the cleaned reports are without.
constexpr double kTakenOut = 0.656;
/// Reports further apart leave the way to the track.
constexpr double kGap_s = 0.25;

const ActuatorTrack::Row& row_at(std::span<const ActuatorTrack::Row> rows, double time_s) {
  const auto row = static_cast<std::size_t>(std::lround(std::max(0.0, time_s) / ActuatorTrack::kStep_s));
  return rows[std::min(row, rows.size() - 1)];
}

/// What rudder and elevator make of three fins' angles; the rest would roll the vehicle (the mixing of the card's
/// interface document, section 4).
Vector3 steering(const Vector3& fins) {
  const double rolling = (fins[0] + fins[1] + fins[2]) / 3;
  return {fins[0] - rolling, fins[1] - rolling, fins[2] - rolling};
}

Vector3 sum(const Vector3& a, double share, const Vector3& b) {
  return {a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]};
}

}  // namespace

std::vector<Vector3> servo_path(std::span<const ActuatorTrack::Row> rows, std::span<const MotorReading> readings,
                                double servo_lag_s, double later_s) {
  // How much more than noise the reports scatter about the cleaned ones.
  std::vector<Vector3> scatter;
  scatter.reserve(readings.size());
  double square = 0;
  for (const MotorReading& reading : readings) {
    scatter.push_back(steering(sum(reading.fins_rad, -1, row_at(rows, reading.time_s).clean_fins_rad)));
    for (const double angle : scatter.back()) square += angle * angle;
  }
  const double noise = kTakenOut * 2 * kNoise_rad * kNoise_rad * static_cast<double>(readings.size());
  const double share = square > noise ? std::sqrt(1 - noise / square) : 0;
  const auto went = [&](std::size_t i) {
    return sum(row_at(rows, readings[i].time_s).clean_fins_rad, share, scatter[i]);
  };

  std::vector<Vector3> path;
  path.reserve(rows.size());
  std::size_t at = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double time_s = static_cast<double>(k) * ActuatorTrack::kStep_s;
    while (at + 1 < readings.size() && readings[at + 1].time_s + later_s <= time_s) ++at;
    const double since_s = time_s - later_s - readings[at].time_s;
    const double interval_s = at + 1 < readings.size() ? readings[at + 1].time_s - readings[at].time_s : kGap_s;
    if (since_s < 0 || interval_s >= kGap_s) {
      path.push_back(rows[k].clean_fins_rad);
      continue;
    }
    const Vector3 from = went(at), to = went(at + 1);
    const double kept = std::exp(-since_s / servo_lag_s), kept_until = std::exp(-interval_s / servo_lag_s);
    path.push_back(sum(from, (1 - kept) / (1 - kept_until), sum(to, -1, from)));
  }
  return path;
}

}  // namespace navcal::gap
