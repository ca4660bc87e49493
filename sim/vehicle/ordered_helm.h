// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "config/vehicle.h"
#include "sim/vehicle/helm.h"

namespace navcal::sim {

/// Moves fins and shaft as it is ordered while the run goes on. Servos and shaft follow with the first-order lags
/// of the vehicle. The motor card limits the shaft: to the autopilot's shaft limit, and to an acceleration of
/// kGreatestAcceleration_rps_s. The run begins at rest at the surface, heading north.
class OrderedHelm final : public Helm {
 public:
  /// 26 rev/s2 is the nominal lag's answer to an order of 780 rpm at rest, and stays below this.
  static constexpr double kGreatestAcceleration_rps_s = 30;
  /// Depth of the origin of a vehicle that lies at the surface.
  static constexpr double kSurface_m = 0.15;

  explicit OrderedHelm(const config::VehicleSettings& vehicle) : vehicle_(vehicle) {}

  /// Takes an order; times are in order, seconds of the run. An order applies from the step whose beginning is
  /// nearest. An order for a past time applies from the next step on.
  void order(double time_s, const Eigen::Vector3d& fins_rad, double shaft_rps);

  [[nodiscard]] Body start() const override;
  [[nodiscard]] Actuators actuators_at_start() const override { return {}; }
  [[nodiscard]] Actuators next(double time_s, double step_s, const Body& body) override;
  [[nodiscard]] bool finished() const override { return false; }

 private:
  struct TimedOrder {
    double time_s;
    Eigen::Vector3d fins_rad;
    double shaft_rps;
  };

  config::VehicleSettings vehicle_;
  std::deque<TimedOrder> waiting_;
  Actuators actuators_;
  Eigen::Vector3d fins_ordered_rad_ = Eigen::Vector3d::Zero();
};

}  // namespace navcal::sim
