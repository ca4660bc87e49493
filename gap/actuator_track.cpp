#include "gap/actuator_track.h"

#include <algorithm>
#include <cmath>
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

/// One servo between two reports: from `from_rad` to `to_rad`, under the command before until `step_s` after the
/// first report, then towards `command_rad`.
struct Piece {
  double from_rad = 0, before_rad = 0, step_s = 0, command_rad = 0;

  [[nodiscard]] double at(double since_s, double lag_s) const {
    const double steady = before_rad + (from_rad - before_rad) * std::exp(-std::min(since_s, step_s) / lag_s);
    if (since_s <= step_s) return steady;
    return command_rad + (steady - command_rad) * std::exp(-(since_s - step_s) / lag_s);
  }
};

/// Of reports a (before), b, c, d at equal intervals; the piece goes from b to c.
Piece piece_between(double a, double b, double c, double d, double interval_s, double lag_s) {
  const double kept = std::exp(-interval_s / lag_s);
  const auto towards = [&](double from, double to) { return (to - kept * from) / (1 - kept); };
  const double before = towards(a, b);  // command until b
  const double carried = before + (b - before) * kept;
  // Under the command before, c would be `carried`; and what the reports' noise leaves of that is no step.
  if (std::abs(c - carried) < kMoved_rad * 1.5) return {b, towards(b, c), interval_s, 0};
  const double command = towards(c, d);
  // When did the command step, if it stood at `before` until then and at `command` from then on?
  // carried' = before + (b - before) e^(-s/T); c - command = (carried' - command) e^(-(h - s)/T)
  //   =>  (c - command) e^(h/T) = (before - command) e^(s/T) + b - before
  const double span = before - command;
  if (std::abs(span) > kMoved_rad) {
    const double grown = ((c - command) / kept - (b - before)) / span;
    const double step_s = grown > 0 ? lag_s * std::log(grown) : -1;
    if (step_s > 0 && step_s < interval_s) return {b, before, step_s, command};
  }
  return {b, towards(b, c), interval_s, 0};
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

}  // namespace

ActuatorTrack::ActuatorTrack(std::span<const MotorReading> readings, double servo_lag_s, double duration_s)
    : rows_(static_cast<std::size_t>(std::ceil(std::max(duration_s, 0.0) / kStep_s)) + 2) {
  for (std::size_t fin = 0; fin < 3; ++fin) {
    std::vector<double> raw;
    raw.reserve(readings.size());
    for (const auto& reading : readings) raw.push_back(reading.fins_rad[fin]);
    const auto angle = smoothed(raw);
    std::size_t at = 0;
    Piece piece;
    bool lagging = false;
    std::size_t made_for = readings.size();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const double time_s = static_cast<double>(k) * kStep_s;
      while (at + 1 < readings.size() && readings[at + 1].time_s <= time_s) ++at;
      double value = angle[at];
      if (at + 1 < readings.size() && time_s > readings[at].time_s) {
        const double interval_s = readings[at + 1].time_s - readings[at].time_s;
        if (made_for != at) {
          made_for = at;
          const std::size_t last = std::min(at + 2, readings.size() - 1);
          lagging = at > 0 && interval_s < kGap_s && readings[at].time_s - readings[at - 1].time_s < kGap_s &&
                    last > at + 1 && readings[last].time_s - readings[at + 1].time_s < kGap_s;
          if (lagging) {
            piece = piece_between(angle[at - 1], angle[at], angle[at + 1], angle[last], interval_s, servo_lag_s);
          }
        }
        const double since_s = time_s - readings[at].time_s;
        value = lagging ? piece.at(since_s, servo_lag_s)
                        : angle[at] + (angle[at + 1] - angle[at]) * since_s / interval_s;
      }
      rows_[k].fins_rad[fin] = value;
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
