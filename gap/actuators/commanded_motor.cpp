// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/commanded_motor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navcal::gap {
namespace {

/// Follows commands with the lags of the nominal servos and shaft.
class NominalMotor {
 public:
  NominalMotor(const Order& first, const config::VehicleSettings& vehicle)
      : vehicle_(vehicle), order_(first), now_{first.time_s, 0, first.fins_rad, kNoCurrent} {}

  void go_on_until(double time_s) {
    const double fins = -std::expm1(-(time_s - now_.time_s) / vehicle_.fins.lag_s);
    const double shaft = -std::expm1(-(time_s - now_.time_s) / vehicle_.propeller.lag_s);
    for (std::size_t i = 0; i < 3; ++i) now_.fins_rad[i] += fins * (order_.fins_rad[i] - now_.fins_rad[i]);
    now_.rpm += shaft * (order_.rpm - now_.rpm);
    now_.time_s = time_s;
  }
  void take(const Order& order) {
    go_on_until(order.time_s);
    order_ = order;
  }
  [[nodiscard]] const MotorReading& now() const { return now_; }

 private:
  static constexpr double kNoCurrent = std::numeric_limits<double>::quiet_NaN();
  const config::VehicleSettings& vehicle_;
  Order order_;
  MotorReading now_;
};

}  // namespace

std::vector<MotorReading> commanded_motor(std::span<const Order> orders, const config::VehicleSettings& vehicle,
                                          double duration_s, double step_s) {
  std::vector<MotorReading> reports;
  if (orders.empty()) return reports;
  NominalMotor motor(orders.front(), vehicle);
  std::size_t next = 1;
  const double begin_s = orders.front().time_s;
  const auto steps = static_cast<int>(std::max(0.0, (duration_s - begin_s) / step_s)) + 1;
  for (int k = 0; k <= steps; ++k) {
    const double time_s = begin_s + k * step_s;
    for (; next < orders.size() && orders[next].time_s <= time_s; ++next) motor.take(orders[next]);
    motor.go_on_until(time_s);
    reports.push_back(motor.now());
  }
  return reports;
}

void obey_orders(Mission& mission, const config::VehicleSettings& vehicle) {
  if (!mission.motor.empty() || mission.orders.empty()) return;
  mission.motor_is_commanded = true;
  mission.motor = commanded_motor(mission.orders, vehicle, mission.duration_s);
}

}  // namespace navcal::gap
