// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <vector>

#include "sim/vehicle/body.h"

namespace navcal::sim {

/// A layout cannot do what is asked of it; what() names the layout, the degree of freedom and the step.
class UnfitLayout : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Source of the commands to a layout's actuators, and of the beginning of the run. Called once a step, in order
/// of time.
class LayoutHelm {
 public:
  virtual ~LayoutHelm() = default;
  [[nodiscard]] virtual Body start() const = 0;
  /// Pulses (sim/layout/pulses.h) that hold over the step that begins at time_s, for a vehicle that is at `body`.
  /// Throws UnfitLayout.
  [[nodiscard]] virtual const std::vector<double>& next(double time_s, double step_s, const Body& body) = 0;
  /// True when the orders have ended once. The helm continues all the same, or begins again.
  [[nodiscard]] virtual bool finished() const = 0;
};

}  // namespace navcal::sim
