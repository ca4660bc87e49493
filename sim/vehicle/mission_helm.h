// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "config/mission.h"
#include "config/vehicle.h"
#include "sim/vehicle/helm.h"
#include "sim/vehicle/manoeuvre.h"

namespace navcal::sim {

/// Takes a vehicle through the steps of a mission by its autopilot. Servos and shaft follow their orders with
/// first-order lags: delta' = (order - delta)/T within the servos' limits, n' = (order - n)/T, exactly over a
/// step. At the end the mission begins again from where the vehicle is, or what was wanted last is wanted on.
class MissionHelm final : public Helm {
 public:
  MissionHelm(const config::VehicleSettings& vehicle, config::Mission mission);

  [[nodiscard]] Body start() const override;
  [[nodiscard]] Actuators actuators_at_start() const override;
  [[nodiscard]] Actuators next(double time_s, double step_s, const Body& body) override;
  [[nodiscard]] bool finished() const override { return finished_; }

 private:
  void give_orders(const Body& body);
  void begin_step(const Situation& now);
  void end_step(const Body& body);

  config::VehicleSettings vehicle_;
  config::Mission mission_;
  Autopilot autopilot_;
  Demand demand_;
  Orders orders_;
  Actuators actuators_;
  std::unique_ptr<Manoeuvre> manoeuvre_;  ///< none: before a step, or after the last
  Situation situation_;
  std::size_t step_ = 0;
  double until_orders_s_ = 0;
  bool finished_ = false;
};

}  // namespace navcal::sim
