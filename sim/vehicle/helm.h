// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <vector>

#include "sim/layout/actuators.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// A layout cannot do what is asked of it; what() names the layout, the degree of freedom and the step.
class UnfitLayout : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Commands to the actuators of a vehicle, and where these are: the shaft in rpm, and the shafts of the servos.
struct Actuators {
  ActuatorValues commands, positions;
  std::vector<double> pulses_us;  ///< commands to the outputs of a layout (sim/layout/pulses.h), which count there
  bool is_new_order = false;      ///< to the motor card, at the beginning of the step
};

/// Source of the commands to a vehicle's actuators, and of the beginning of the run. Called once a step, in order
/// of time.
class Helm {
 public:
  virtual ~Helm() = default;
  [[nodiscard]] virtual Body start() const = 0;
  [[nodiscard]] virtual ActuatorValues positions_at_start() const = 0;
  /// Writes the commands that hold over the step that begins at time_s, for a vehicle that is at `body`. Throws
  /// UnfitLayout.
  virtual void next(double time_s, double step_s, const Body& body, Actuators& actuators) = 0;
  enum class Positions {
    follow,   ///< the commands, as the layout's actuators do; over a step they have the mean of both ends
    written,  ///< by next(), those at the end of the step; over a step they have the mean of both ends
    held,     ///< written likewise; over a step surfaces are those of its end, thrusters those of its beginning
  };
  [[nodiscard]] virtual Positions positions() const { return Positions::follow; }
  /// True when the orders have ended once. The helm continues all the same, or begins again.
  [[nodiscard]] virtual bool finished() const = 0;
};

}  // namespace navcal::sim
