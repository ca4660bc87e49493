// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/command_check.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/angles.h"
#include "gap/actuators/commanded_motor.h"
#include "protocols/motor_card.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::gap {
namespace {

constexpr double kStep_s = 0.02;
constexpr double kEarliest_s = -1, kMostDelay_s = 10;
/// Correlation below which commands and motion have nothing to do with each other.
constexpr double kLeastCorrelation = 0.6;
constexpr double kLeastMove_rad = 0.3 * base::kRadiansPerDegree;  ///< standard deviation
constexpr double kMoved_rad = 1 * base::kRadiansPerDegree;
constexpr double kAtLimit_rad = 0.1 * base::kRadiansPerDegree;

/// A quantity every kStep_s from `begin_s` on.
struct OrderedSeries {
  double begin_s = 0;
  std::vector<double> values;
};

/// A measured quantity at the times of its readings.
struct Measured {
  std::vector<double> times_s, values;
};

/// Sums for a correlation coefficient of two quantities, over several pairs of series. Each pair has its own
/// means.
class Correlation {
 public:
  void add(const OrderedSeries& predicted, const Measured& measured, double late_s) {
    double n = 0, sum_p = 0, sum_m = 0, pp = 0, mm = 0, pm = 0;
    for (std::size_t i = 0; i < measured.values.size(); ++i) {
      const double place = (measured.times_s[i] - late_s - predicted.begin_s) / kStep_s;
      if (place < 0 || place >= static_cast<double>(predicted.values.size())) continue;
      const double p = predicted.values[static_cast<std::size_t>(place)], m = measured.values[i];
      n += 1;
      sum_p += p;
      sum_m += m;
      pp += p * p;
      mm += m * m;
      pm += p * m;
    }
    if (!(n > 0)) return;
    count_ += n;
    predicted_ += pp - sum_p * sum_p / n;
    measured_ += mm - sum_m * sum_m / n;
    together_ += pm - sum_p * sum_m / n;
  }
  [[nodiscard]] double value() const {
    const double size = std::sqrt(predicted_ * measured_);
    return size > 0 ? together_ / size : 0;
  }
  /// Standard deviation of what is predicted.
  [[nodiscard]] double spread() const { return count_ > 0 ? std::sqrt(predicted_ / count_) : 0; }

 private:
  double count_ = 0, predicted_ = 0, measured_ = 0, together_ = 0;
};

struct Delay {
  double late_s = 0, correlation = 0, spread = 0;
};

Delay delay_of(std::span<const OrderedSeries> predicted, std::span<const Measured> measured) {
  std::vector<double> values;
  Delay best;
  const auto steps = static_cast<int>(std::lround((kMostDelay_s - kEarliest_s) / kStep_s));
  for (int k = 0; k <= steps; ++k) {
    Correlation correlation;
    const double late_s = kEarliest_s + k * kStep_s;
    for (std::size_t i = 0; i < predicted.size(); ++i) correlation.add(predicted[i], measured[i], late_s);
    values.push_back(correlation.value());
    if (values.back() > best.correlation) best = {late_s, values.back(), correlation.spread()};
  }
  // A reading falls within a step: on average half a step after its beginning.
  const auto at = static_cast<std::size_t>(std::lround((best.late_s - kEarliest_s) / kStep_s));
  best.late_s -= kStep_s / 2;
  if (at > 0 && at + 1 < values.size()) {
    const double bend = values[at - 1] - 2 * values[at] + values[at + 1];
    if (bend < 0) best.late_s += kStep_s * (values[at - 1] - values[at + 1]) / (2 * bend);
  }
  return best;
}

/// Delay of the reported fins behind servos that obey the commands.
Delay delay_of_reports(const Mission& mission, const config::VehicleSettings& vehicle) {
  const auto obeying = commanded_motor(mission.orders, vehicle, mission.duration_s, kStep_s);
  std::vector<OrderedSeries> predicted(3);
  std::vector<Measured> measured(3);
  for (std::size_t fin = 0; fin < 3; ++fin) {
    predicted[fin].begin_s = obeying.front().time_s;
    for (const MotorReading& reading : obeying) predicted[fin].values.push_back(reading.fins_rad[fin]);
    for (const MotorReading& reading : mission.motor) {
      measured[fin].times_s.push_back(reading.time_s);
      measured[fin].values.push_back(reading.fins_rad[fin]);
    }
  }
  return delay_of(predicted, measured);
}

/// Yaw rate of the nominal vehicle under the commands, from rest.
OrderedSeries commanded_yaw_rate(const Mission& mission, const config::VehicleSettings& settings) {
  const auto obeying = commanded_motor(mission.orders, settings, mission.duration_s, kStep_s);
  const sim::LayoutVehicle vehicle(sim::layout_of(settings));
  sim::Body body;
  OrderedSeries yaw{obeying.front().time_s, {}};
  for (const MotorReading& reading : obeying) {
    const auto& fins = reading.fins_rad;
    const sim::ActuatorValues held{{reading.rpm}, {fins[0], fins[1], fins[2]}, {}, {}};
    body = vehicle.midpoint_step(body, held, held, kStep_s);
    // Turns follow from rudder and speed. The depth that nobody holds here is not to matter.
    body.euler_rad.setZero();
    body.position_m.setZero();
    if (!body.velocity.allFinite()) break;
    yaw.values.push_back(body.velocity[5]);
  }
  return yaw;
}

Measured measured_yaw_rate(const Mission& mission) {
  Measured yaw;
  for (const CardReading& reading : mission.card) {
    if (!std::isfinite(reading.gyro_rad_s[1])) continue;
    yaw.times_s.push_back(reading.time_s);
    yaw.values.push_back(reading.gyro_rad_s[1]);
  }
  return yaw;
}

/// Delay of the measured yaw rate behind that of the nominal vehicle.
Delay delay_of_turns(const Mission& mission, const config::VehicleSettings& vehicle) {
  const OrderedSeries predicted = commanded_yaw_rate(mission, vehicle);
  const Measured measured = measured_yaw_rate(mission);
  return delay_of({&predicted, 1}, {&measured, 1});
}

bool is_at_limit(const Vector3& fins_rad, double limit_rad) {
  return std::ranges::any_of(fins_rad,
                             [&](double fin_rad) { return std::abs(fin_rad) > limit_rad - kAtLimit_rad; });
}

double saturated_share(const Mission& mission, const config::VehicleSettings& vehicle) {
  const double limit_rad =
      std::min(vehicle.fins.limit_rad, protocols::motor_card::kFinLimit_deg * base::kRadiansPerDegree);
  double at_limit_s = 0, together_s = 0;
  const auto add = [&](const Vector3& fins_rad, double seconds) {
    together_s += seconds;
    if (is_at_limit(fins_rad, limit_rad)) at_limit_s += seconds;
  };
  for (std::size_t i = 0; i < mission.orders.size(); ++i) {
    const double until_s = i + 1 < mission.orders.size() ? mission.orders[i + 1].time_s : mission.duration_s;
    add(mission.orders[i].fins_rad, std::max(0.0, until_s - mission.orders[i].time_s));
  }
  if (mission.orders.empty()) {
    for (const MotorReading& reading : mission.motor) add(reading.fins_rad, 1);
  }
  return together_s > 0 ? at_limit_s / together_s : 0;
}

double unrecorded_share(const Mission& mission) {
  if (mission.orders.empty() || mission.motor_is_commanded || !(mission.duration_s > 0)) return 0;
  double seconds = 0;
  for (const Silence& silence : silences_of(Quantity::motor, mission.commanded_s, mission.duration_s)) {
    std::optional<Vector3> first;
    bool moved = false;
    for (const MotorReading& reading : mission.motor) {
      if (reading.time_s < silence.from_s + 1 || reading.time_s > silence.until_s) continue;
      if (!first) first = reading.fins_rad;
      for (std::size_t i = 0; i < 3; ++i)
        moved = moved || std::abs(reading.fins_rad[i] - (*first)[i]) > kMoved_rad;
    }
    if (moved) seconds += silence.until_s - silence.from_s;
  }
  return seconds / mission.duration_s;
}

}  // namespace

CommandCheck check_commands(const Mission& mission, const config::VehicleSettings& vehicle) {
  CommandCheck check;
  check.saturated = saturated_share(mission, vehicle);
  check.unrecorded = unrecorded_share(mission);
  if (mission.orders.empty()) return check;
  check.by_reports = !mission.motor_is_commanded;
  const Delay delay = check.by_reports ? delay_of_reports(mission, vehicle) : delay_of_turns(mission, vehicle);
  if (!(delay.spread > kLeastMove_rad)) return check;
  check.correlation = delay.correlation;
  if (delay.correlation > kLeastCorrelation) check.delay_s = delay.late_s;
  return check;
}

}  // namespace navcal::gap
