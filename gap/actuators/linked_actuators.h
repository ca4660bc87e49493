// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "gap/actuators/actuator_track.h"
#include "sim/effects/effect_set.h"
#include "sim/vehicle/vehicle.h"

namespace navcal::gap {

/// Fins and shaft as the vehicle feels them: what the motor card reported, behind the linkage that effects put
/// between the servos and the fins.
class LinkedActuators {
 public:
  /// `rows`, of which there are two at least, must outlive it.
  LinkedActuators(std::span<const ActuatorTrack::Row> rows, sim::EffectSet& effects);

  /// Of the rows, that at this time or just before; the first and the last go on for ever.
  [[nodiscard]] std::size_t row_at(double time_s) const;
  [[nodiscard]] sim::Controls of_row(std::size_t row) const;
  /// Means over a time.
  [[nodiscard]] sim::Controls mean(double from_s, double until_s) const;

 private:
  [[nodiscard]] sim::Controls integral_until(double time_s) const;

  std::span<const ActuatorTrack::Row> rows_;
  std::vector<Eigen::Vector3d> fins_rad_;
  std::vector<sim::Controls> integrals_;  ///< from the beginning until each row
};

}  // namespace navcal::gap
