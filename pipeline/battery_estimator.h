// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "config/settings.h"
#include "pipeline/battery.h"

namespace navcal::pipeline {

/// Charge of a battery, with its standard deviation.
///
/// Model, an extended Kalman filter over four states: charge q (Ah), relative error k of the measured current,
/// error h of the hotel load (A), error b of the open-circuit curve (V).
///   q' = -((1 + k) I + hotel + h) / 3600 s   with the motor's current I; without the hotel terms where the gauge
///                                            measures the whole current
///   z  = curve(q / capacity) + b + noise     z = voltage + resistance I, after a rest
/// k and h are constant, so that the standard deviation grows in proportion to the charge taken. b is a
/// Gauss-Markov process over the charge taken, so that many readings at one charge do not count as many. The curve
/// is linearised again at each step of an iterated update (Bell and Cathey, IEEE Trans. Automatic Control 38,
/// 1993), because a battery of unknown charge begins far from the solution.
///
/// While no current comes, the mean load is counted, and all of it is uncertain. Times are those of the caller and
/// never decrease; an earlier one counts as the newest. No memory is taken after construction, and no clock read.
class BatteryEstimator {
 public:
  explicit BatteryEstimator(const config::BatterySettings& settings);

  /// The charge is known. Values are held between 0 and the capacity; what is not a number is left out.
  void set(const BatteryCharge& charge);
  /// Current of the motor. Left out while the gauge measures the whole current.
  void motor_current(std::int64_t time_ns, double current_A);
  /// Current and voltage at the pack. Values that are not a number are left out.
  void gauge(std::int64_t time_ns, const std::optional<double>& current_A, const std::optional<double>& voltage_V);
  void speed(std::int64_t time_ns, double speed_m_s);
  /// Time has passed.
  void advance(std::int64_t time_ns);

  /// Nullopt before set() and before the voltage has shown the charge.
  [[nodiscard]] std::optional<BatteryCharge> charge() const;
  /// Current out of the pack now; nullopt while no instrument tells it.
  [[nodiscard]] std::optional<double> current_A() const;
  [[nodiscard]] bool current_is_measured() const { return measures_all(); }
  /// Nullopt without a gauge, and soon after its last reading.
  [[nodiscard]] std::optional<double> voltage_V() const;
  /// Nullopt while charge or load are unknown.
  [[nodiscard]] std::optional<double> time_left_s() const;
  [[nodiscard]] std::optional<double> range_left_m() const;

 private:
  using Vector = Eigen::Vector4d;
  using Matrix = Eigen::Matrix4d;
  using Time = std::optional<std::int64_t>;

  [[nodiscard]] bool is_current(const Time& time_ns) const;
  [[nodiscard]] bool measures_all() const { return is_current(gauge_ns_); }
  void count(double duration_s, double load_A);
  void count_unseen(double duration_s);
  void wander(double taken_Ah);
  void correct(double open_circuit_V);
  [[nodiscard]] bool has_rested() const;
  void hold_in_bounds();

  config::BatterySettings settings_;
  Vector state_ = Vector::Zero();
  Matrix covariance_ = Matrix::Zero();
  bool known_ = false;
  Time time_ns_, motor_ns_, gauge_ns_, voltage_ns_, speed_ns_;
  double motor_A_ = 0, gauge_A_ = 0;
  std::optional<double> voltage_V_;
  Time rest_since_ns_, corrected_ns_;
  std::optional<double> mean_load_A_, mean_speed_m_s_;
};

}  // namespace navcal::pipeline
