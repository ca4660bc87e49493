// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "autopilot/allocation.h"
#include "autopilot/autopilot.h"
#include "sim/layout/control/axis_control.h"
#include "sim/layout/control/control_plan.h"
#include "sim/layout/control/glide_control.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::sim {

/// The speed that a shaft speed counts as: 0.0872 m a revolution, as of the reference vehicle.
[[nodiscard]] double speed_of_shaft(double shaft_rps);

/// Demanded motion to the commands of any layout, by its nominal model; it uses the true state.
///   tau = feed-forward + M_ii a_i in each commanded degree of freedom, and 0 in the others, which count nothing
///   feed-forward: what the model needs at the demanded speeds and attitude, -force(nu demanded) with actuators
///   neutral,
///     and against the moments of pitch and yaw of sway and heave, where these turn the vehicle across its way
///     (Munk)
///   a: surge by the error of the speed and its integral; yaw, heave, roll, pitch by axis_control.h; sway brakes
///   pitch demanded (DepthControl::pitch) = e/(T u) + integral, nose up when too deep, within 25 degrees
/// The commands are those of autopilot::Allocator for tau. Loops are as fast as the slowest actuator that serves
/// them allows: w = min(1.2, 0.35/(lag + period)) rad/s, 0.6 at most in heave. A rudder of 25 degrees is the whole
/// yaw moment that can be had, an elevator likewise; fins 1 to 3 are surfaces. A shaft speed counts as the speed
/// that the reference vehicle has with it, 0.0872 m a revolution. Speeds beyond ControlPlan::greatest_m_s are held
/// there.
class LayoutAutopilot {
 public:
  LayoutAutopilot(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator, const ControlPlan& plan);

  /// `period_s`: since the last commands.
  [[nodiscard]] ActuatorValues commands(const autopilot::Demand& demand, const Body& body, double period_s);
  /// What the last commands amount to as rudder, elevator and fins.
  [[nodiscard]] const autopilot::Orders& last() const { return last_; }

 private:
  struct Attitude {
    double pitch_rad = 0;
    Vector6 velocity = Vector6::Zero();  ///< demanded
  };
  [[nodiscard]] double speed_demanded(const autopilot::Demand& demand) const;
  [[nodiscard]] double pitch_for_depth(double too_deep_m, double surge_m_s, double demanded_m_s, double period_s);
  /// Acceleration in each commanded degree of freedom; notes the velocities and the attitude that are demanded.
  [[nodiscard]] Vector6 accelerations(const autopilot::Demand& demand, const Body& body, double period_s,
                                      Attitude& wanted);
  [[nodiscard]] Vector6 feed_forward(const Attitude& wanted, const Body& body) const;
  void allocate(const autopilot::Demand& demand, const Body& body, const Vector6& wrench,
                ActuatorValues& commands);

  const LayoutVehicle& vehicle_;
  const autopilot::Allocator& allocator_;
  ControlPlan plan_;
  LayoutVehicle::Held neutral_;
  std::array<AxisControl, 6> axes_;
  GlideControl glide_;
  Vector6 attainable_ = Vector6::Zero();  ///< force and moment in each degree of freedom, at the present speed
  bool is_thrust_limited_ = false;
  double speed_integral_ = 0;  ///< m/s2
  double depth_integral_rad_ = 0;
  autopilot::Orders last_;
};

}  // namespace navcal::sim
