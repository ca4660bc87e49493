// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "gap/actuators/servo_orders.h"
#include "gap/data/mission.h"

namespace navcal::gap {

/// What three fins' servos were ordered, by the motor card's reports: as rolling, rudder and elevator, which have
/// nothing to do with each other and in which the reports' noise is the same.
class FinOrders {
 public:
  /// Instants of orders ascending, on the readings' time; at least one reading. `report_noise_rad`: of a reported
  /// angle.
  FinOrders(std::span<const MotorReading> readings, std::span<const double> order_times_s, double servo_lag_s,
            double report_noise_rad);

  /// Angles of the servos' shafts every `step_s` from time zero on, rad.
  [[nodiscard]] std::vector<Vector3> servos_rad(std::size_t count, double step_s) const;
  /// One of the ways that they may have gone, as far as the reports allow; `later_s` later.
  [[nodiscard]] std::vector<Vector3> drawn_servos_rad(std::size_t count, double step_s, double later_s,
                                                      sim::Noise& noise) const;
  /// Mean square of what the orders leave of the reports, of the reports' noise: about one, if the fins moved by
  /// these orders.
  [[nodiscard]] double misfit() const;
  /// The instants of orders that there are reports of.
  [[nodiscard]] std::span<const double> order_times_s() const { return smoothers_.front().order_times_s(); }

 private:
  static constexpr std::size_t kWays = 3;
  /// To what the card takes.
  static void round_off(std::array<ServoOrders, kWays>& orders);
  /// At these ascending times.
  [[nodiscard]] std::vector<Vector3> followed(const std::array<ServoOrders, kWays>& orders,
                                              std::span<const double> times_s) const;

  double lag_s_, report_noise_rad_;
  std::vector<double> report_times_s_;
  std::array<std::vector<double>, kWays> reports_rad_;
  std::vector<ServoSmoother> smoothers_;
  std::array<ServoOrders, kWays> orders_;
};

/// Every tenth of a second, `phase_s` after the whole ones: what helmsmen of this kind of vehicle do.
[[nodiscard]] std::vector<double> regular_orders(double phase_s, double duration_s);

}  // namespace navcal::gap
