// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "sim/layout/layout_helm.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/vehicle/simulated_motion.h"
#include "sim/vehicle/step_history.h"

namespace navcal::sim {

/// The vehicle of a layout under way, as SimulatedMotion is that of one propeller and three fins. Besides the
/// forces of LayoutVehicle, the hull floats: what is above the water has no buoyancy, clamp(1/2 - z/H, 0, 1) of
/// it, with depth z of the origin and height H of the vehicle (body.size_m, or the cube root of what it
/// displaces). The shaft, the fins and the motor current of its states are zero: it has outputs instead. Not for
/// several threads at once.
class LayoutMotion final : public Motion {
 public:
  /// Interval at which outputs are told.
  static constexpr std::int64_t kOutputs_ns = 100'000'000;

  /// Throws UnstableVehicle. `options.influencer` may change the layout; the helm takes pulses for the nominal
  /// one.
  LayoutMotion(config::Layout layout, std::unique_ptr<LayoutHelm> helm, const MotionOptions& options);

  /// State at t_ns; before the run, that of its beginning. Throws UnstableVehicle, UnfitLayout.
  [[nodiscard]] State at(std::int64_t t_ns) const override;
  void take_outputs(std::int64_t t_ns, std::vector<OutputOrder>& out) const override;
  /// Duration of the orders, seconds from the start, which the call simulates. Throws UnstableVehicle,
  /// UnfitLayout.
  [[nodiscard]] double duration_s() const;
  /// Positions of the actuators after the newest step.
  [[nodiscard]] const ActuatorValues& positions() const { return positions_; }

 private:
  void take_step() const;
  void change_layout(double time_s) const;

  config::Layout nominal_;
  MotionOptions options_;
  double height_m_;
  mutable LayoutVehicle vehicle_;
  mutable double next_change_s_ = 0;
  mutable std::unique_ptr<LayoutHelm> helm_;
  mutable Body body_;
  mutable ActuatorValues positions_;
  mutable StepHistory states_;
  mutable std::deque<OutputOrder> outputs_;  ///< not yet taken
  mutable std::optional<double> ended_s_;
};

}  // namespace navcal::sim
