// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>

#include "config/vehicle.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/state.h"
#include "sim/vehicle/helm.h"
#include "sim/vehicle/step_history.h"

namespace navcal::sim {

/// Options of a SimulatedMotion besides the vehicle and its helm.
struct MotionOptions {
  std::int64_t start_ns = 0;                ///< when the run begins
  VehicleInfluencer* influencer = nullptr;  ///< must outlive the motion
  /// Time for which states are kept, seconds. A request for an older state returns the oldest one. A state
  /// takes 0.2 kB, so a run that lasts for days needs a bound.
  double history_s = std::numeric_limits<double>::infinity();
};

/// A vehicle under way: taken ahead in steps of 0.01 s as far as it is asked for, states between steps in a
/// straight line. After its helm's orders have ended it goes on as the helm does. Not for several threads at once.
class SimulatedMotion final : public Motion {
 public:
  static constexpr std::int64_t kStep_ns = kMotionStep_ns;

  SimulatedMotion(const config::VehicleSettings& vehicle, std::unique_ptr<Helm> helm,
                  const MotionOptions& options);

  /// State at t_ns; before the run, that of its beginning. Throws UnstableVehicle.
  [[nodiscard]] State at(std::int64_t t_ns) const override;
  /// Appends the orders up to t_ns. Orders older than `history_s` are dropped as well.
  void take_orders(std::int64_t t_ns, std::vector<Order>& out) const override;
  /// Duration of the orders, seconds from the start. The call simulates up to that time, so states older than
  /// `history_s` before it are dropped. Throws UnstableVehicle.
  [[nodiscard]] double duration_s() const;

 private:
  void take_step() const;
  [[nodiscard]] State state_of(const Vector6& acceleration, const Influences& influences) const;

  LayoutVehicle vehicle_;
  config::PropellerSettings propeller_;
  MotionOptions options_;
  // The motion is what it is from the beginning on; only as much of it as was asked for has been worked out.
  mutable std::unique_ptr<Helm> helm_;
  mutable Body body_;
  mutable Actuators actuators_;
  mutable std::optional<Eigen::Vector3d> linked_rad_;  ///< the fins themselves, behind their linkage
  mutable StepHistory states_;
  mutable std::deque<Order> orders_;  ///< not yet taken
  mutable std::optional<double> ended_s_;
};

}  // namespace navcal::sim
