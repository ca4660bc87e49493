// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "autopilot/autopilot.h"
#include "autopilot/manoeuvre.h"
#include "config/mission.h"
#include "config/vehicle.h"

namespace navcal::autopilot {

/// The motion that the steps of a mission demand, one after the other. At the end the mission begins again from
/// where the vehicle is, or what was wanted last is wanted on, as the mission says.
class MissionSteps {
 public:
  explicit MissionSteps(config::Mission mission);

  /// Way through the water since the last call of next().
  void add_way(double way_m) { situation_.way_m += way_m; }
  /// `period_s`: since the last call; `last`: the orders given last.
  const Demand& next(const VehicleState& state, double period_s, const Orders& last);
  [[nodiscard]] const Demand& demand() const { return demand_; }
  [[nodiscard]] const config::Mission& mission() const { return mission_; }
  /// The step under way, or the one that comes next.
  [[nodiscard]] std::size_t step() const { return step_; }
  /// Time and way since the step began.
  [[nodiscard]] double since_s() const { return situation_.since_s; }
  [[nodiscard]] double way_m() const { return situation_.way_m; }
  /// Times at which the steps began for the first time, so far, s since the first call of next().
  [[nodiscard]] const std::vector<double>& began_s() const { return began_s_; }
  /// All steps were done once.
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  void begin_step();
  void end_step();

  config::Mission mission_;
  Demand demand_;
  std::unique_ptr<Manoeuvre> manoeuvre_;  ///< none: before a step, or after the last
  Situation situation_;
  std::size_t step_ = 0;
  double now_s_ = 0;
  std::vector<double> began_s_{0};
  bool finished_ = false;
};

/// The orders that take a vehicle of one propeller and three fins through the steps of a mission.
class MissionOrders {
 public:
  MissionOrders(const config::VehicleSettings& vehicle, config::Mission mission);

  /// Way through the water since the last call of next().
  void add_way(double way_m) { steps_.add_way(way_m); }
  /// `period_s`: since the last call. Fins are rounded to tenths of a degree, the resolution of the motor card.
  const Orders& next(const VehicleState& state, double period_s);
  [[nodiscard]] const Orders& last() const { return orders_; }
  [[nodiscard]] const Demand& demand() const { return steps_.demand(); }
  [[nodiscard]] const config::Mission& mission() const { return steps_.mission(); }
  /// The step under way, or the one that comes next.
  [[nodiscard]] std::size_t step() const { return steps_.step(); }
  [[nodiscard]] const std::vector<double>& began_s() const { return steps_.began_s(); }
  /// All steps were done once.
  [[nodiscard]] bool finished() const { return steps_.finished(); }

 private:
  MissionSteps steps_;
  Autopilot autopilot_;
  Orders orders_;
};

}  // namespace navcal::autopilot
