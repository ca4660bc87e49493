// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "autopilot/autopilot.h"
#include "autopilot/manoeuvre.h"
#include "config/mission.h"
#include "config/vehicle.h"

namespace navcal::autopilot {

/// The orders that take a vehicle through the steps of a mission. At the end the mission begins again from where
/// the vehicle is, or what was wanted last is wanted on, as the mission says.
class MissionOrders {
 public:
  MissionOrders(const config::VehicleSettings& vehicle, config::Mission mission);

  /// Way through the water since the last call of next().
  void add_way(double way_m) { situation_.way_m += way_m; }
  /// `period_s`: since the last call. Fins are rounded to tenths of a degree, the resolution of the motor card.
  const Orders& next(const VehicleState& state, double period_s);
  [[nodiscard]] const Orders& last() const { return orders_; }
  [[nodiscard]] const Demand& demand() const { return demand_; }
  [[nodiscard]] const config::Mission& mission() const { return mission_; }
  /// The step under way, or the one that comes next.
  [[nodiscard]] std::size_t step() const { return step_; }
  /// All steps were done once.
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  void begin_step();
  void end_step();

  config::Mission mission_;
  Autopilot autopilot_;
  Demand demand_;
  Orders orders_;
  std::unique_ptr<Manoeuvre> manoeuvre_;  ///< none: before a step, or after the last
  Situation situation_;
  std::size_t step_ = 0;
  bool finished_ = false;
};

}  // namespace navcal::autopilot
