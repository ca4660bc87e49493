// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "gap/actuators/actuator_track.h"
#include "sim/effects/effect_set.h"
#include "sim/layout/layout_of.h"

namespace navcal::gap {

/// Fin angles and shaft speed that act on the vehicle: the servo angles of the motor card's reports, behind the
/// linkage that effects put between the servos and the fins.
class LinkedActuators {
 public:
  /// `rows` must outlive it. At least two rows.
  LinkedActuators(std::span<const ActuatorTrack::Row> rows, sim::EffectSet& effects);

  /// Index of the row at this time or just before. The first row holds before the beginning, the last one after
  /// the end.
  [[nodiscard]] std::size_t row_at(double time_s) const;
  [[nodiscard]] sim::Controls of_row(std::size_t row) const;
  /// Mean controls from `from_s` until `until_s`.
  [[nodiscard]] sim::Controls mean(double from_s, double until_s) const;

 private:
  [[nodiscard]] sim::Controls integral_until(double time_s) const;

  std::span<const ActuatorTrack::Row> rows_;
  std::vector<Eigen::Vector3d> fins_rad_;
  std::vector<sim::Controls> integrals_;  ///< from the beginning until each row
};

}  // namespace navcal::gap
