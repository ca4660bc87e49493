// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>

#include "sim/layout/layout_helm.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/vehicle/stepped_motion.h"

namespace navcal::sim {

/// The vehicle of a layout under way. Besides the forces of LayoutVehicle, the hull floats: what is above the
/// water has no buoyancy (body.size_m tells its height, else the cube root of what it displaces). The shaft, the
/// fins and the motor current of its states are zero: it has outputs instead.
class LayoutMotion final : public SteppedMotion {
 public:
  /// Interval at which outputs are told.
  static constexpr std::int64_t kOutputs_ns = 100'000'000;

  /// Throws UnstableVehicle. `options.influencer` may change the layout; the helm takes pulses for the nominal
  /// one.
  LayoutMotion(config::Layout layout, std::unique_ptr<LayoutHelm> helm, const MotionOptions& options);

  void take_outputs(std::int64_t t_ns, std::vector<OutputOrder>& out) const override { take(outputs_, t_ns, out); }
  /// Positions of the actuators after the newest step.
  [[nodiscard]] const ActuatorValues& positions() const { return positions_; }

 private:
  void take_step() const override;
  void change_layout(double time_s) const;

  config::Layout nominal_;
  double height_m_;
  mutable LayoutVehicle vehicle_;
  mutable double next_change_s_ = 0;
  mutable std::unique_ptr<LayoutHelm> helm_;
  mutable ActuatorValues positions_;
  mutable std::deque<OutputOrder> outputs_;  ///< not yet taken
};

}  // namespace navcal::sim
