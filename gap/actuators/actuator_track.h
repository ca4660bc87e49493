// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "gap/actuators/fin_orders.h"
#include "gap/data/mission.h"

namespace navcal::gap {

/// What the motor card's reports, ten a second with noise and resolution, say of the servos' shafts, the
/// propeller's and the current in between. A coarser picture of the fins shows as noise in everything that the
/// vehicle does: a servo that was told something right after a report is ahead of a straight line to the next one
/// by 5 ms, and one that turns about within a tenth of a second is degrees off it.
class ActuatorTrack {
 public:
  static constexpr double kStep_s = 0.01;

  struct Row {
    Vector3 fins_rad{};  ///< of the servos' shafts
    double shaft_rps = 0;
  };

  /// `servo_lag_s`: of the nominal servo. Readings in order of time, at least one.
  ActuatorTrack(std::span<const MotorReading> readings, std::span<const double> order_times_s, double servo_lag_s,
                const devices::MotorModel& card, double duration_s);

  [[nodiscard]] const FinOrders& orders() const { return orders_; }
  /// At k kStep_s, k = 0 ... covering the duration.
  [[nodiscard]] std::span<const Row> rows() const { return rows_; }
  /// Of the motor, amperes: `nominal_A` of the shaft speed, which has no noise, and the mean difference of the
  /// reports from that over some seconds. At the times of rows().
  [[nodiscard]] std::vector<double> current_A(std::span<const MotorReading> readings,
                                              std::span<const double> nominal_A) const;

 private:
  FinOrders orders_;
  double report_s_;  ///< between two reports
  std::vector<Row> rows_;
};

}  // namespace navcal::gap
