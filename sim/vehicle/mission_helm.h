// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "autopilot/mission_orders.h"
#include "autopilot/vehicle_state.h"
#include "config/mission.h"
#include "config/vehicle.h"
#include "sim/layout/layout_of.h"
#include "sim/vehicle/helm.h"

namespace navcal::sim {

/// The body at the beginning of a mission.
[[nodiscard]] Body body_at(const config::MissionStart& start);
/// The true state: an autopilot of the simulator steers by it.
[[nodiscard]] autopilot::VehicleState vehicle_state(const Body& body);

/// Takes a vehicle of one propeller and three fins through the steps of a mission by its autopilot, which steers
/// by the true state. At the end the mission begins again from where the vehicle is, or what was wanted last is
/// wanted on.
class MissionHelm final : public Helm {
 public:
  MissionHelm(const config::VehicleSettings& vehicle, config::Mission mission);

  [[nodiscard]] Body start() const override { return body_at(orders_.mission().start); }
  [[nodiscard]] ActuatorValues positions_at_start() const override {
    return Controls{Eigen::Vector3d::Zero(), orders_.mission().start.shaft_rps}.values();
  }
  void next(double time_s, double step_s, const Body& body, Actuators& actuators) override;
  [[nodiscard]] bool finished() const override { return orders_.finished(); }
  /// Times at which the steps began, so far.
  [[nodiscard]] const std::vector<double>& step_began_s() const { return orders_.began_s(); }

 private:
  double period_s_;
  autopilot::MissionOrders orders_;
  double until_orders_s_ = 0;
};

}  // namespace navcal::sim
