// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "autopilot/allocation.h"
#include "autopilot/autopilot.h"
#include "autopilot/mission_orders.h"
#include "config/layout.h"
#include "config/mission.h"
#include "sim/layout/control/control_plan.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/vehicle/mission_helm.h"

namespace navcal::sim {

/// Depth by ballast and moving masses. With e = depth demanded - depth - 20 s times the speed down, and s =
/// clamp(e/2 m, -1, 1): the ballast goes to the part s of its range on the heavy side (below zero: light), and
/// moving masses to where weight and buoyancy balance at a pitch of -25 degrees times s, with an integral of the
/// pitch.
class GlideControl {
 public:
  explicit GlideControl(const LayoutVehicle& vehicle);

  /// Writes the commands of ballasts and moving masses.
  void command(double depth_demanded_m, const Body& body, double period_s, ActuatorValues& commands);

 private:
  config::Layout layout_;
  double stiffness_Nm_;        ///< W times the metacentric height
  double net_weight_N_;        ///< with ballast at zero
  double pitch_integral_ = 0;  ///< rad s
};

/// Control of one degree of freedom by a cascade: position to rate to acceleration.
///   rate wanted = rate demanded + clamp(w/2 e, +-rate limit),   e = position demanded - position
///   acceleration = 2 w (rate wanted - rate) + integral of w^3/10 e
/// w is the natural frequency of the loop, critically damped. The integral is for what stands against the vehicle
/// all the time: it grows only while the rate is not limited, and not beyond half of what can be had.
class AxisControl {
 public:
  AxisControl() = default;
  explicit AxisControl(double w_rad_s) : w_rad_s_(w_rad_s) {}

  struct Demand {
    double error = 0, rate = 0, rate_demanded = 0;
    double rate_limit = 0;
    double greatest = 0;  ///< acceleration that actuators give
  };
  struct Wanted {
    double rate = 0;
    double acceleration = 0;
  };
  [[nodiscard]] Wanted next(const Demand& demand, double period_s) {
    const double by_error = w_rad_s_ / 2 * demand.error;
    if (std::abs(by_error) < demand.rate_limit) {
      const double most = 0.5 * demand.greatest;
      integral_ =
          std::clamp(integral_ + w_rad_s_ * w_rad_s_ * w_rad_s_ / 10 * demand.error * period_s, -most, most);
    }
    const double rate = demand.rate_demanded + std::clamp(by_error, -demand.rate_limit, demand.rate_limit);
    return {rate, 2 * w_rad_s_ * (rate - demand.rate) + integral_};
  }
  /// Rate from which 70 % of the greatest acceleration brakes within the loop's own time.
  [[nodiscard]] double rate_limit(double greatest, double low, double high) const {
    return std::clamp(0.7 * greatest / (w_rad_s_ / 2), low, high);
  }
  [[nodiscard]] double w_rad_s() const { return w_rad_s_; }

 private:
  double w_rad_s_ = 1;
  double integral_ = 0;
};

/// The speed that a shaft speed counts as: 0.0872 m a revolution, as of the reference vehicle.
[[nodiscard]] double speed_of_shaft(double shaft_rps);

/// Demanded motion to the commands of any layout, by its nominal model; it uses the true state.
///   tau = feed-forward + M_ii a_i in each commanded degree of freedom, and 0 in the others, which count nothing
///   feed-forward: what the model needs at the demanded speeds and attitude, -force(nu demanded) with actuators
///   neutral,
///     and against the moments of pitch and yaw of sway and heave, where these turn the vehicle across its way
///     (Munk)
///   a: surge by the error of the speed and its integral; yaw, heave, roll, pitch by AxisControl; sway brakes
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

/// Takes a layout through the steps of a mission by its autopilot, ten times a second.
class LayoutMissionHelm final : public Helm {
 public:
  static constexpr double kPeriod_s = 0.1;

  /// Throws UnfitLayout where the layout cannot be steered as the mission needs.
  LayoutMissionHelm(const config::Layout& layout, config::Mission mission);
  // The autopilot refers to the vehicle beside it.
  LayoutMissionHelm(const LayoutMissionHelm&) = delete;
  LayoutMissionHelm& operator=(const LayoutMissionHelm&) = delete;

  [[nodiscard]] Body start() const override { return body_at(steps_.mission().start); }
  [[nodiscard]] ActuatorValues positions_at_start() const override {
    return ActuatorValues::neutral(vehicle_.layout());
  }
  void next(double time_s, double step_s, const Body& body, Actuators& actuators) override;
  [[nodiscard]] bool finished() const override { return steps_.finished(); }
  /// Times at which the steps began, so far.
  [[nodiscard]] const std::vector<double>& step_began_s() const { return steps_.began_s(); }
  [[nodiscard]] const ControlPlan& plan() const { return plan_; }
  /// What is less than the mission asks for: "speeds are held at 0.48 m/s, ..."; empty: nothing.
  [[nodiscard]] std::string remark() const;

 private:
  /// Throws UnfitLayout on a leg of metres along which the vehicle hardly moves.
  void expect_progress() const;

  LayoutVehicle vehicle_;
  autopilot::Allocator allocator_;
  autopilot::MissionSteps steps_;
  ControlPlan plan_;
  LayoutAutopilot autopilot_;
  double until_orders_s_ = 0;
};

}  // namespace navcal::sim
