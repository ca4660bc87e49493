#include "gap/actuator_track.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace navcal::gap {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// Of one report: noise and resolution.
constexpr double kReportNoise_rad = 0.11 * kDegree;
/// A move that noise does not explain.
constexpr double kMoved_rad = 5 * kReportNoise_rad;
/// Reports further apart are not interpolated by the lag.
constexpr double kGap_s = 0.25;
constexpr double kCurrentMean_s = 4;

/// One servo between two reports of `interval_s`.
struct Piece {
  enum class Kind : std::uint8_t {
    smooth,   ///< under commands that change all the time
    steady,   ///< on its way to one command
    stepped,  ///< under one command until `step_s` after the first report, then on its way to another
  };
  Kind kind = Kind::smooth;
  double from_rad = 0, to_rad = 0, interval_s = 0;
  double slope_from_rad_s = 0, slope_to_rad_s = 0;
  double before_rad = 0, step_s = 0, command_rad = 0;

  [[nodiscard]] double at(double since_s, double lag_s) const {
    if (kind == Kind::smooth) {
      // Hermite's cubic: an exponential would go too early from one report to the next, by 5 ms in the mean.
      const double x = since_s / interval_s, y = 1 - x;
      return from_rad * y * y * (1 + 2 * x) + to_rad * x * x * (1 + 2 * y) +
             interval_s * x * y * (slope_from_rad_s * y - slope_to_rad_s * x);
    }
    const double step = kind == Kind::steady ? 0 : step_s;
    const double carried = before_rad + (from_rad - before_rad) * std::exp(-std::min(since_s, step) / lag_s);
    if (since_s <= step) return carried;
    return command_rad + (carried - command_rad) * std::exp(-(since_s - step) / lag_s);
  }
};

/// Of reports a (before), b, c, d at equal intervals; the piece goes from b to c.
Piece piece_between(double a, double b, double c, double d, double interval_s, double lag_s) {
  Piece piece;
  piece.from_rad = b;
  piece.to_rad = c;
  piece.interval_s = interval_s;
  piece.slope_from_rad_s = (c - a) / (2 * interval_s);
  piece.slope_to_rad_s = (d - b) / (2 * interval_s);
  const double kept = std::exp(-interval_s / lag_s);
  const auto towards = [&](double from, double to) { return (to - kept * from) / (1 - kept); };
  const double before = towards(a, b), during = towards(b, c), after = towards(c, d);
  if (std::abs(c - b) > kMoved_rad && std::abs(during - after) < kMoved_rad) {
    piece.kind = Piece::Kind::steady;
    piece.command_rad = during;
    return piece;
  }
  // Under the command before, c would be `carried`; what the reports' noise leaves of that is no step.
  const double carried = before + (b - before) * kept;
  if (std::abs(c - carried) < 1.5 * kMoved_rad || std::abs(before - after) < kMoved_rad) return piece;
  // When did the command step, if it stood at `before` until then and at `after` from then on?
  // carried' = before + (b - before) e^(-s/T); c - after = (carried' - after) e^(-(h - s)/T)
  //   =>  (c - after) e^(h/T) = (before - after) e^(s/T) + b - before
  const double grown = ((c - after) / kept - (b - before)) / (before - after);
  const double step_s = grown > 0 ? lag_s * std::log(grown) : -1;
  if (step_s <= 0 || step_s >= interval_s) return piece;
  piece.kind = Piece::Kind::stepped;
  piece.before_rad = before;
  piece.step_s = step_s;
  piece.command_rad = after;
  return piece;
}

/// A report between neighbours that lie on one line with it is their mean: a steady fin's noise goes down.
std::vector<double> smoothed(const std::vector<double>& raw) {
  std::vector<double> smooth = raw;
  for (std::size_t i = 2; i + 2 < raw.size(); ++i) {
    const double slope = (raw[i + 2] + raw[i + 1] - raw[i - 1] - raw[i - 2]) / 6;
    const double mean = (raw[i - 2] + raw[i - 1] + raw[i] + raw[i + 1] + raw[i + 2]) / 5;
    double worst = 0;
    for (int k = -2; k <= 2; ++k) {
      worst = std::max(worst, std::abs(raw[i + static_cast<std::size_t>(k + 2) - 2] - mean - k * slope));
    }
    if (worst < 2.5 * kReportNoise_rad) smooth[i] = mean;
  }
  return smooth;
}

/// Each report by a line through those near it in time and in angle: steady fins and slow moves lose their noise,
/// steps stay.
std::vector<double> without_noise(const std::vector<double>& raw) {
  constexpr int kReach = 6;
  constexpr double kNear = 1.5;  // reports
  constexpr double kAlike_rad = 5 * kReportNoise_rad;
  const auto count = static_cast<int>(raw.size());
  std::vector<double> clean(raw.size());
  for (int i = 0; i < count; ++i) {
    double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
    const double here = raw[static_cast<std::size_t>(i)];
    for (int j = std::max(0, i - kReach); j <= std::min(count - 1, i + kReach); ++j) {
      const double x = j - i, y = raw[static_cast<std::size_t>(j)] - here;
      const double weight = std::exp(-0.5 * (x * x / (kNear * kNear) + y * y / (kAlike_rad * kAlike_rad)));
      w += weight;
      wx += weight * x;
      wxx += weight * x * x;
      wy += weight * y;
      wxy += weight * x * y;
    }
    const double determinant = w * wxx - wx * wx;
    clean[static_cast<std::size_t>(i)] =
        here + (determinant > 1e-9 ? (wxx * wy - wx * wxy) / determinant : wy / w);
  }
  return clean;
}

/// Angles at the times of rows, of one servo whose reports say `angle`.
std::vector<double> between_reports(std::span<const MotorReading> readings, const std::vector<double>& angle,
                                    double servo_lag_s, std::size_t rows) {
  std::vector<double> result(rows);
  std::size_t at = 0, made_for = readings.size();
  Piece piece;
  bool lagging = false;
  for (std::size_t k = 0; k < rows; ++k) {
    const double time_s = static_cast<double>(k) * ActuatorTrack::kStep_s;
    while (at + 1 < readings.size() && readings[at + 1].time_s <= time_s) ++at;
    result[k] = angle[at];
    if (at + 1 >= readings.size() || time_s <= readings[at].time_s) continue;
    const double interval_s = readings[at + 1].time_s - readings[at].time_s;
    if (made_for != at) {
      made_for = at;
      const std::size_t last = std::min(at + 2, readings.size() - 1);
      lagging = at > 0 && interval_s < kGap_s && readings[at].time_s - readings[at - 1].time_s < kGap_s &&
                last > at + 1 && readings[last].time_s - readings[at + 1].time_s < kGap_s;
      if (lagging)
        piece = piece_between(angle[at - 1], angle[at], angle[at + 1], angle[last], interval_s, servo_lag_s);
    }
    const double since_s = time_s - readings[at].time_s;
    result[k] =
        lagging ? piece.at(since_s, servo_lag_s) : angle[at] + (angle[at + 1] - angle[at]) * since_s / interval_s;
  }
  return result;
}

}  // namespace

ActuatorTrack::ActuatorTrack(std::span<const MotorReading> readings, double servo_lag_s, double duration_s)
    : rows_(static_cast<std::size_t>(std::ceil(std::max(duration_s, 0.0) / kStep_s)) + 2) {
  for (std::size_t fin = 0; fin < 3; ++fin) {
    std::vector<double> raw;
    raw.reserve(readings.size());
    for (const auto& reading : readings) raw.push_back(reading.fins_rad[fin]);
    const auto reported = between_reports(readings, smoothed(raw), servo_lag_s, rows_.size());
    const auto clean = between_reports(readings, without_noise(raw), servo_lag_s, rows_.size());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      rows_[k].fins_rad[fin] = reported[k];
      rows_[k].clean_fins_rad[fin] = clean[k];
    }
  }
  std::size_t at = 0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const double time_s = static_cast<double>(k) * kStep_s;
    while (at + 1 < readings.size() && readings[at + 1].time_s <= time_s) ++at;
    double rpm = readings[at].rpm;
    if (at + 1 < readings.size() && time_s > readings[at].time_s) {
      const double part = (time_s - readings[at].time_s) / (readings[at + 1].time_s - readings[at].time_s);
      rpm += part * (readings[at + 1].rpm - rpm);
    }
    rows_[k].shaft_rps = rpm / 60;
  }
}

std::vector<double> ActuatorTrack::current_A(std::span<const MotorReading> readings,
                                             std::span<const double> nominal_A) const {
  std::vector<double> excess(rows_.size());
  double mean = 0;
  bool begun = false;
  for (int pass = 0; pass < 2; ++pass) {  // forth and back, so that nothing lags
    std::size_t at = pass == 0 ? 0 : readings.size();
    const auto row_of = [&](const MotorReading& reading) {
      return static_cast<std::size_t>(
          std::clamp(reading.time_s / kStep_s, 0.0, static_cast<double>(rows_.size() - 1)));
    };
    for (std::size_t n = 0; n < rows_.size(); ++n) {
      const std::size_t k = pass == 0 ? n : rows_.size() - 1 - n;
      const auto take = [&](const MotorReading& reading) {
        const double difference = reading.current_A - nominal_A[row_of(reading)];
        mean += (begun ? 0.1 / kCurrentMean_s : 1.0) * (difference - mean);
        begun = true;
      };
      if (pass == 0) {
        while (at < readings.size() && row_of(readings[at]) <= k) take(readings[at++]);
      } else {
        while (at > 0 && row_of(readings[at - 1]) >= k) take(readings[--at]);
      }
      excess[k] += mean / 2;
    }
  }
  std::vector<double> current(rows_.size());
  for (std::size_t k = 0; k < current.size(); ++k) current[k] = nominal_A[k] + excess[k];
  return current;
}

}  // namespace navcal::gap
