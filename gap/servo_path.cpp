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
/// Rolling of cleaned reports up to which it is their noise: three standard deviations of what is left of it.
constexpr double kRollingNoise_rad = 3 * 0.026 * std::numbers::pi / 180;
/// Reports further apart leave the way to the track.
constexpr double kGap_s = 0.25;

const ActuatorTrack::Row& row_at(std::span<const ActuatorTrack::Row> rows, double time_s) {
  const auto row = static_cast<std::size_t>(std::lround(std::max(0.0, time_s) / ActuatorTrack::kStep_s));
  return rows[std::min(row, rows.size() - 1)];
}

/// What rudder and elevator do not make of three fins' angles: it would roll the vehicle (the mixing of the card's
/// interface document, section 4).
double rolling(const Vector3& fins) { return (fins[0] + fins[1] + fins[2]) / 3; }

/// The rest of them.
Vector3 steering(const Vector3& fins) {
  const double rolls = rolling(fins);
  return {fins[0] - rolls, fins[1] - rolls, fins[2] - rolls};
}

/// Cleaned reports without the rolling that is their noise. Fins that rudder and elevator move do not roll the
/// vehicle; one that was moved by the noise of the recorded reports would, and the replay would foresee it.
Vector3 without_rolling_noise(const Vector3& fins) {
  const double rolls = rolling(fins);
  const double noise = kRollingNoise_rad / std::max(std::abs(rolls), kRollingNoise_rad);
  const double less = noise * noise * rolls;
  return {fins[0] - less, fins[1] - less, fins[2] - less};
}

/// The card takes tenths of a degree, fin by fin; what that rounds off rolls the vehicle a little all the time.
Vector3 commandable(Vector3 fins) {
  constexpr double kTenth_rad = 0.1 * std::numbers::pi / 180;
  for (double& angle : fins) angle = std::round(angle / kTenth_rad) * kTenth_rad;
  return fins;
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
    const Vector3 clean = without_rolling_noise(row_at(rows, readings[i].time_s).clean_fins_rad);
    return sum(clean, share, scatter[i]);
  };

  std::vector<Vector3> path;
  path.reserve(rows.size());
  std::size_t at = 0, commanded_after = readings.size();
  Vector3 from = went(0), command = from;
  const auto servos_after = [&](double since_s) {
    return sum(command, std::exp(-since_s / servo_lag_s), sum(from, -1, command));
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double time_s = static_cast<double>(k) * ActuatorTrack::kStep_s;
    while (at + 1 < readings.size() && readings[at + 1].time_s + later_s <= time_s) ++at;
    const double since_s = time_s - later_s - readings[at].time_s;
    const double interval_s = at + 1 < readings.size() ? readings[at + 1].time_s - readings[at].time_s : kGap_s;
    if (since_s < 0 || interval_s >= kGap_s) {
      path.push_back(rows[k].clean_fins_rad);
      commanded_after = readings.size();
      continue;
    }
    if (commanded_after != at) {
      // From where the command before left it, or from the report if there was none.
      const bool follows = at > 0 && commanded_after == at - 1;
      from = follows ? servos_after(readings[at].time_s - readings[at - 1].time_s) : went(at);
      const double kept = std::exp(-interval_s / servo_lag_s);
      command = commandable(sum(from, 1 / (1 - kept), sum(went(at + 1), -1, from)));
      commanded_after = at;
    }
    path.push_back(servos_after(since_s));
  }
  return path;
}

}  // namespace navcal::gap
