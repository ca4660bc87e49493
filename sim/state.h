// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/gravity.h"
#include "base/reference_instruments.h"

namespace navcal::sim {

using Vector3 = std::array<double, 3>;

using base::kGravity_m_s2;

[[nodiscard]] inline double water_temperature_C(double depth_m) {
  return base::reference::kTemperature_C - 0.25 * depth_m;
}

/// True state of the vehicle at one instant (docs/simulator.md). Body axes x forward, y starboard, z down;
/// world axes north, east, down.
struct State {
  Vector3 position_m{};  ///< north, east, down
  Vector3 euler_rad{};   ///< roll, pitch, yaw; yaw is not wrapped
  Vector3 velocity_body_m_s{};
  Vector3 rate_rad_s{};           ///< body rates p, q, r
  Vector3 specific_force_m_s2{};  ///< body axes, at the origin; (0, 0, -9.81) at rest
  double rpm_commanded = 0;
  double rpm = 0;
  Vector3 fins_rad{};                   ///< of the servos' shafts, as the motor card reports them
  double motor_current_A = 0;           ///< drawn by the motor, without the sensor's noise
  std::array<double, 2> current_m_s{};  ///< of the water, north and east: course over ground is velocity plus this
  Vector3 field_world_uT = base::reference::kField_uT;
  double water_temperature_C = base::reference::kTemperature_C;
};

/// Linear interpolation between two near instants. Values that change only in jumps are those of `a`.
[[nodiscard]] State between(const State& a, const State& b, double part);

/// One order to the motor card.
struct Order {
  std::int64_t time_ns = 0;  ///< UTC since the epoch
  double rpm = 0;
  Vector3 fins_rad{};
};

/// Commands to all actuators of a layout at one instant.
struct OutputOrder {
  std::int64_t time_ns = 0;       ///< UTC since the epoch
  std::vector<double> pulses_us;  ///< in the order of sim/layout/pulses.h
};

/// Motion of the vehicle, at any time and in any order of times. The devices have no other source of it.
class Motion {
 public:
  virtual ~Motion() = default;
  /// `t_ns`: UTC since the epoch.
  [[nodiscard]] virtual State at(std::int64_t t_ns) const = 0;
  /// Appends what the motor card was told up to t_ns and was not yet taken, in order of time. Along a path it is
  /// told nothing.
  virtual void take_orders(std::int64_t /*t_ns*/, std::vector<Order>& /*out*/) const {}
  /// Appends what the actuators of a layout were told up to t_ns and was not yet taken, in order of time. Other
  /// vehicles have a motor card.
  virtual void take_outputs(std::int64_t /*t_ns*/, std::vector<OutputOrder>& /*out*/) const {}
};

}  // namespace navcal::sim
