// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "gap/actuators/servo_orders.h"
#include "gap/data/mission.h"

namespace navcal::gap {

/// Commands of the three fin servos, recorded or estimated from the motor card's reports. They are kept as roll,
/// rudder and elevator: these are independent of each other, and the reports' noise is the same in each.
class FinOrders {
 public:
  /// `order_times_s`: ascending, on the readings' time. At least one reading. `report_noise_rad`: standard
  /// deviation of a reported angle. `ordered_fins_rad`: one for each order, or none where they were not recorded.
  FinOrders(std::span<const MotorReading> readings, std::span<const double> order_times_s,
            std::span<const Vector3> ordered_fins_rad, double servo_lag_s, double report_noise_rad);

  /// Angles of the servos' shafts every `step_s` from time zero on, rad.
  [[nodiscard]] std::vector<Vector3> servos_rad(std::size_t count, double step_s) const;
  /// A draw from the servo angles that the reports allow, `later_s` later.
  [[nodiscard]] std::vector<Vector3> drawn_servos_rad(std::size_t count, double step_s, double later_s,
                                                      sim::Noise& noise) const;
  /// Mean square difference between reports and estimated angles, in units of the report variance. It is about
  /// one if the fins moved by these orders.
  [[nodiscard]] double misfit() const;
  /// Whether all fins moved as the recorded orders said.
  [[nodiscard]] bool obeys() const;
  /// Instants of the orders that lie between reports.
  [[nodiscard]] std::span<const double> order_times_s() const { return smoothers_.front().order_times_s(); }

 private:
  static constexpr std::size_t kWays = 3;
  /// Rounds estimated commands to the resolution of the card.
  static void round_off(std::array<ServoOrders, kWays>& orders);
  /// Servo angles under these orders at ascending times.
  [[nodiscard]] std::vector<Vector3> followed(const std::array<ServoOrders, kWays>& orders,
                                              std::span<const double> times_s) const;

  double lag_s_, report_noise_rad_;
  std::vector<double> report_times_s_;
  std::array<std::vector<double>, kWays> reports_rad_;
  std::vector<ServoSmoother> smoothers_;
  std::array<ServoOrders, kWays> orders_;
};

/// Order times every tenth of a second, `phase_s` after the whole ones, as the autopilots of this kind of
/// vehicle give them.
[[nodiscard]] std::vector<double> regular_orders(double phase_s, double duration_s);

}  // namespace navcal::gap
