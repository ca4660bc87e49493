// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "gap/actuators/fin_orders.h"
#include "gap/data/mission.h"
#include "sim/effects/effect_set.h"
#include "sim/layout/layout_of.h"

namespace navcal::gap {

/// Angles of the servos' shafts, propeller speed and motor current on a 10 ms grid, estimated from the motor
/// card's reports. The reports come ten times a second with noise and resolution. Any coarser reconstruction of
/// the fins adds noise to the predicted motion. Linear interpolation is 5 ms late for a servo that was ordered
/// to move right after a report. It is off by degrees for one that reverses within a tenth of a second.
class ActuatorTrack {
 public:
  static constexpr double kStep_s = 0.01;

  struct Row {
    Vector3 fins_rad{};  ///< of the servos' shafts
    double shaft_rps = 0;
  };

  /// `servo_lag_s`: lag of the nominal servo. Readings in order of time, at least one.
  /// `ordered_fins_rad`: one for each order; empty: not recorded.
  ActuatorTrack(std::span<const MotorReading> readings, std::span<const double> order_times_s,
                std::span<const Vector3> ordered_fins_rad, double servo_lag_s, const devices::MotorModel& card,
                double duration_s);

  [[nodiscard]] const FinOrders& orders() const { return orders_; }
  /// Row k is at time k kStep_s; the rows cover the duration.
  [[nodiscard]] std::span<const Row> rows() const { return rows_; }
  /// Motor current, A, at the times of rows(): `nominal_A` of the shaft speed, which has no noise, plus the
  /// mean difference of the reports from it over some seconds.
  [[nodiscard]] std::vector<double> current_A(std::span<const MotorReading> readings,
                                              std::span<const double> nominal_A) const;

 private:
  FinOrders orders_;
  double report_s_;  ///< between two reports
  std::vector<Row> rows_;
};

/// Fin angles and shaft speed that act on the vehicle: the servo angles of the motor card's reports, behind the
/// linkage that effects put between the servos and the fins.
class LinkedActuators {
 public:
  /// `rows` must outlive it. At least two rows.
  LinkedActuators(std::span<const ActuatorTrack::Row> rows, sim::EffectSet& effects);

  /// Index of the row at this time or just before. The first row holds before the beginning, the last one after
  /// the end.
  [[nodiscard]] std::size_t row_at(double time_s) const;
  [[nodiscard]] sim::Controls of_row(std::size_t row) const;
  /// Mean controls from `from_s` until `until_s`.
  [[nodiscard]] sim::Controls mean(double from_s, double until_s) const;

 private:
  [[nodiscard]] sim::Controls integral_until(double time_s) const;

  std::span<const ActuatorTrack::Row> rows_;
  std::vector<Eigen::Vector3d> fins_rad_;
  std::vector<sim::Controls> integrals_;  ///< from the beginning until each row
};

}  // namespace navcal::gap
