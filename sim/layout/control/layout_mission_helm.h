// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "autopilot/mission_steps.h"
#include "config/layout.h"
#include "config/mission.h"
#include "sim/layout/control/layout_autopilot.h"
#include "sim/layout/layout_helm.h"
#include "sim/vehicle/mission_helm.h"

namespace navcal::sim {

/// Takes a layout through the steps of a mission by its autopilot, ten times a second.
class LayoutMissionHelm final : public LayoutHelm {
 public:
  static constexpr double kPeriod_s = 0.1;

  /// Throws UnfitLayout where the layout cannot be steered as the mission needs.
  LayoutMissionHelm(const config::Layout& layout, config::Mission mission);
  // The autopilot refers to the vehicle beside it.
  LayoutMissionHelm(const LayoutMissionHelm&) = delete;
  LayoutMissionHelm& operator=(const LayoutMissionHelm&) = delete;

  [[nodiscard]] Body start() const override { return body_at(steps_.mission().start); }
  [[nodiscard]] const std::vector<double>& next(double time_s, double step_s, const Body& body) override;
  [[nodiscard]] bool finished() const override { return steps_.finished(); }
  [[nodiscard]] const ControlPlan& plan() const { return plan_; }
  /// What is less than the mission asks for: "speeds are held at 0.48 m/s, ..."; empty: nothing.
  [[nodiscard]] std::string remark() const;

 private:
  /// Throws UnfitLayout on a leg of metres along which the vehicle hardly moves.
  void expect_progress() const;

  LayoutVehicle vehicle_;
  autopilot::Allocator allocator_;
  autopilot::MissionSteps steps_;
  ControlPlan plan_;
  LayoutAutopilot autopilot_;
  std::vector<double> pulses_us_;
  double until_orders_s_ = 0;
};

}  // namespace navcal::sim
