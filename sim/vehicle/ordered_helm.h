// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "config/layout.h"
#include "config/vehicle.h"
#include "sim/vehicle/helm.h"

namespace navcal::sim {

/// Moves the actuators of a vehicle as it is ordered while the run goes on. The run begins at rest at the surface,
/// heading north, with all neutral.
class OrderedHelm final : public Helm {
 public:
  /// 26 rev/s2 is the nominal lag's answer to an order of 780 rpm at rest, and stays below this.
  static constexpr double kGreatestAcceleration_rps_s = 30;
  /// Depth of the origin of a vehicle that lies at the surface.
  static constexpr double kSurface_m = 0.15;

  /// Ordered by a motor card with one propeller and three fins: rpm, and three angles (rad). The card limits the
  /// shaft to the autopilot's shaft limit, and to an acceleration of kGreatestAcceleration_rps_s.
  explicit OrderedHelm(const config::VehicleSettings& vehicle);
  /// Ordered by the outputs of a layout: pulses in us (sim/layout/pulses.h).
  explicit OrderedHelm(const config::Layout& layout);

  /// Takes an order; nullopt leaves a number as it is. Times are in order, seconds of the run. An order applies
  /// from the step whose beginning is nearest; one for a past time, from the next step on.
  void order(double time_s, std::vector<std::optional<double>> numbers) {
    waiting_.push_back({time_s, std::move(numbers)});
  }

  [[nodiscard]] Body start() const override;
  [[nodiscard]] ActuatorValues positions_at_start() const override { return ActuatorValues::neutral(layout_); }
  void next(double time_s, double step_s, const Body& body, Actuators& actuators) override;
  [[nodiscard]] Positions positions() const override { return is_card_ ? Positions::written : Positions::follow; }
  [[nodiscard]] bool finished() const override { return false; }

 private:
  struct TimedOrder {
    double time_s;
    std::vector<std::optional<double>> numbers;
  };

  config::Layout layout_;
  bool is_card_;
  std::vector<double> numbers_;  ///< as they were ordered
  std::deque<TimedOrder> waiting_;
};

}  // namespace navcal::sim
