// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "sim/vehicle/body.h"

namespace navcal::sim {

/// Where the servos and the shaft are.
struct Actuators {
  Eigen::Vector3d fins_rad = Eigen::Vector3d::Zero();  ///< of the servos' shafts
  double shaft_rps = 0;
  double shaft_commanded_rps = 0;
  /// Ordered angles of the servos, when the step began with a new order to the motor card.
  std::optional<Eigen::Vector3d> fins_ordered_rad{};
};

/// Source of a vehicle's fins and propeller speed, and of the beginning of the run. Called once a step, in
/// order of time.
class Helm {
 public:
  virtual ~Helm() = default;
  [[nodiscard]] virtual Body start() const = 0;
  [[nodiscard]] virtual Actuators actuators_at_start() const = 0;
  /// Actuators at time_s + step_s, for a vehicle that is at `body` at time_s.
  [[nodiscard]] virtual Actuators next(double time_s, double step_s, const Body& body) = 0;
  /// False: over a step the actuators have the mean of both ends. True: the fins are those of its end and the
  /// shaft speed that of its beginning.
  [[nodiscard]] virtual bool holds_over_steps() const { return false; }
  /// True when the orders have ended once. The helm continues all the same, or begins again.
  [[nodiscard]] virtual bool finished() const = 0;
};

}  // namespace navcal::sim
