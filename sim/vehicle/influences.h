// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "config/layout.h"
#include "sim/state.h"

namespace navcal::sim {

/// Changes of the vehicle itself by effects; all neutral by default.
struct Influences {
  double thrust_factor = 1;             ///< of the thrusters' force
  double yaw_damping_per_s = 0;         ///< N = -k M66 r more
  double buoyancy_N = 0;                ///< net upward force at the origin
  std::array<double, 2> current_m_s{};  ///< north, east: moves the position only
};

/// Interface of effects that change the vehicle: one propeller and three fins by influence() and link_fins(), a
/// layout by influence() and change_layout(). Called once a step, in order of time.
class VehicleInfluencer {
 public:
  virtual ~VehicleInfluencer() = default;
  virtual void influence(double time_s, Influences& on) = 0;
  /// Converts angles of the servos' shafts, which the motor card reports, to angles of the fins; `step_s` since
  /// the last call.
  virtual void link_fins(double time_s, double step_s, Vector3& fins_rad) = 0;
  /// Changes a nominal layout to what it is at this time; it stays so until next_layout_change_s().
  virtual void change_layout(double /*time_s*/, config::Layout& /*layout*/) {}
  /// The next time after time_s at which the layout changes.
  [[nodiscard]] virtual double next_layout_change_s(double /*time_s*/) const {
    return std::numeric_limits<double>::infinity();
  }
};

}  // namespace navcal::sim
