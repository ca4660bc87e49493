// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "config/vehicle.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/vehicle/helm.h"
#include "sim/vehicle/stepped_motion.h"

namespace navcal::sim {

/// The vehicle of one propeller and three fins under way.
class SimulatedMotion final : public SteppedMotion {
 public:
  SimulatedMotion(const config::VehicleSettings& vehicle, std::unique_ptr<Helm> helm,
                  const MotionOptions& options);

  /// Appends the orders up to t_ns. Orders older than `history_s` are dropped as well.
  void take_orders(std::int64_t t_ns, std::vector<Order>& out) const override { take(orders_, t_ns, out); }

 private:
  void take_step() const override;

  LayoutVehicle vehicle_;
  config::PropellerSettings propeller_;
  config::HullSettings hull_;
  mutable std::unique_ptr<Helm> helm_;
  mutable Actuators actuators_;
  mutable std::optional<Eigen::Vector3d> linked_rad_;  ///< the fins themselves, behind their linkage
  mutable std::deque<Order> orders_;                   ///< not yet taken
};

}  // namespace navcal::sim
