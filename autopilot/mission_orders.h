// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "autopilot/autopilot.h"
#include "autopilot/mission_steps.h"
#include "config/mission.h"
#include "config/vehicle.h"

namespace navcal::autopilot {

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
