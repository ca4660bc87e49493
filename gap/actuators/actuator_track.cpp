// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/actuator_track.h"

#include <algorithm>
#include <cmath>

namespace navcal::gap {
namespace {

constexpr double kStep_s = ActuatorTrack::kStep_s;

constexpr double kCurrentMean_s = 4;

}  // namespace

LinkedActuators::LinkedActuators(std::span<const ActuatorTrack::Row> rows, sim::EffectSet& effects) : rows_(rows) {
  sim::Controls sum;
  fins_rad_.reserve(rows.size());
  integrals_.reserve(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    sim::Vector3 linked_rad = rows[k].fins_rad;
    effects.link_fins(static_cast<double>(k) * kStep_s, kStep_s, linked_rad);
    fins_rad_.emplace_back(linked_rad[0], linked_rad[1], linked_rad[2]);
    if (k > 0) {
      sum.fins_rad += kStep_s / 2 * (fins_rad_[k - 1] + fins_rad_[k]);
      sum.shaft_rps += kStep_s / 2 * (rows[k - 1].shaft_rps + rows[k].shaft_rps);
    }
    integrals_.push_back(sum);
  }
}

std::size_t LinkedActuators::row_at(double time_s) const {
  return static_cast<std::size_t>(std::clamp(time_s / kStep_s, 0.0, static_cast<double>(rows_.size() - 1)));
}

sim::Controls LinkedActuators::of_row(std::size_t row) const { return {fins_rad_[row], rows_[row].shaft_rps}; }

sim::Controls LinkedActuators::integral_until(double time_s) const {
  const double place = std::clamp(time_s / kStep_s, 0.0, static_cast<double>(integrals_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(place), integrals_.size() - 2);
  const double part = place - static_cast<double>(k);
  const auto &a = integrals_[k], &b = integrals_[k + 1];
  return {a.fins_rad + part * (b.fins_rad - a.fins_rad), a.shaft_rps + part * (b.shaft_rps - a.shaft_rps)};
}

sim::Controls LinkedActuators::mean(double from_s, double until_s) const {
  constexpr double kLeast_s = 1e-3;
  until_s = std::max(until_s, from_s + kLeast_s);
  if (until_s >= static_cast<double>(rows_.size() - 1) * kStep_s) return of_row(rows_.size() - 1);
  const auto a = integral_until(from_s), b = integral_until(until_s);
  return {(b.fins_rad - a.fins_rad) / (until_s - from_s), (b.shaft_rps - a.shaft_rps) / (until_s - from_s)};
}

ActuatorTrack::ActuatorTrack(std::span<const MotorReading> readings, std::span<const double> order_times_s,
                             std::span<const Vector3> ordered_fins_rad, double servo_lag_s,
                             const devices::MotorModel& card, double duration_s)
    : orders_(readings, order_times_s, ordered_fins_rad, servo_lag_s, card.fin_report_noise_rad()),
      report_s_(1 / card.timing.rate_Hz),
      rows_(static_cast<std::size_t>(std::ceil(std::max(duration_s, 0.0) / kStep_s)) + 2) {
  const auto servos_rad = orders_.servos_rad(rows_.size(), kStep_s);
  for (std::size_t k = 0; k < rows_.size(); ++k) rows_[k].fins_rad = servos_rad[k];
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
        if (!std::isfinite(reading.current_A)) return;
        const double difference = reading.current_A - nominal_A[row_of(reading)];
        mean += (begun ? std::min(report_s_ / kCurrentMean_s, 1.0) : 1.0) * (difference - mean);
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
