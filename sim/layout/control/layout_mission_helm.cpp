// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/control/layout_mission_helm.h"

#include <fmt/format.h>

#include <utility>

#include "autopilot/shaft_speed.h"
#include "base/angles.h"
#include "base/gravity.h"
#include "sim/layout/control/control_plan.h"
#include "sim/layout/mass_matrix.h"
#include "sim/layout/pulses.h"

namespace navcal::sim {
namespace {

constexpr double kGlide_rad = 25 * base::kRadiansPerDegree;
constexpr double kAhead_s = 20;
constexpr double kFull_m = 2;

double speed_down(const Body& body) { return body.velocity.head<3>().dot(down_of(body.euler_rad)); }

constexpr double kPeriod_s = 0.1;
constexpr double kRudder_rad = 25 * base::kRadiansPerDegree;  ///< the whole moment
constexpr double kGreatestPitch_rad = 25 * base::kRadiansPerDegree;
constexpr double kAttitude = 10;  ///< weight of moments over forces where not all can be had
constexpr double kFastestTurn_rad_s = 0.7;

Eigen::VectorXd most_of(const autopilot::Allocator::Limits& limits) {
  return limits.low.cwiseAbs().cwiseMax(limits.high.cwiseAbs());
}

/// The longest lag of actuators that give a tenth or more of what the strongest gives in this degree of freedom.
double lag_of(const autopilot::Allocator& allocator, const Eigen::MatrixXd& B, const Eigen::VectorXd& most,
              Eigen::Index freedom) {
  const Eigen::VectorXd gives = B.row(freedom).transpose().cwiseAbs().cwiseProduct(most);
  const double strongest = gives.size() > 0 ? gives.maxCoeff() : 0;
  double lag_s = 0;
  const config::Layout& layout = allocator.layout();
  const auto thrusters = layout.thrusters.size();
  for (std::size_t i = 0; i < static_cast<std::size_t>(gives.size()); ++i) {
    if (gives[static_cast<Eigen::Index>(i)] < 0.1 * strongest) continue;
    lag_s = std::max(lag_s, i < thrusters ? layout.thrusters[i].lag_s : layout.surfaces[i - thrusters].lag_s);
  }
  return lag_s;
}

double turn_rate(const Body& body) {
  return (std::sin(body.euler_rad[0]) * body.velocity[4] + std::cos(body.euler_rad[0]) * body.velocity[5]) /
         std::cos(body.euler_rad[1]);
}

}  // namespace

GlideControl::GlideControl(const LayoutVehicle& vehicle) : layout_(vehicle.layout()) {
  const Restoring restoring = vehicle.hold(ActuatorValues::neutral(layout_)).restoring;
  stiffness_Nm_ = restoring.arm_Nm.z();
  net_weight_N_ = restoring.net_weight_N;
}

void GlideControl::command(double depth_demanded_m, const Body& body, double period_s, ActuatorValues& commands) {
  const double error_m = depth_demanded_m - body.position_m.z() - kAhead_s * speed_down(body);
  const double part = std::clamp(error_m / kFull_m, -1.0, 1.0);
  double range_N = 0;
  for (const config::LayoutBallast& ballast : layout_.ballasts) range_N += (ballast.high_N - ballast.low_N) / 2;
  // What is out of balance is taken back first, by all ballasts in the same part of their range.
  const double light = range_N > 0 ? std::clamp(net_weight_N_ / range_N - part, -1.0, 1.0) : 0;
  for (std::size_t i = 0; i < layout_.ballasts.size(); ++i) {
    const config::LayoutBallast& ballast = layout_.ballasts[i];
    commands.ballasts_N[i] = (ballast.high_N + ballast.low_N) / 2 + light * (ballast.high_N - ballast.low_N) / 2;
  }
  const double pitch_rad = -kGlide_rad * part;
  const double pitch_error_rad = pitch_rad - body.euler_rad.y();
  constexpr double kIntegral_per_s = 0.02, kMost_rad = 10 * base::kRadiansPerDegree;
  pitch_integral_ =
      std::clamp(pitch_integral_ + kIntegral_per_s * pitch_error_rad * period_s, -kMost_rad, kMost_rad);
  double moment_m_kg = 0;
  for (const config::LayoutMovingMass& mass : layout_.moving_masses)
    moment_m_kg += mass.mass_kg * std::abs(vector_of(mass.axis).normalized().x());
  if (!(moment_m_kg > 0)) return;
  // A mass s ahead turns the nose down by m g s cos pitch; weight and buoyancy turn it back by W h sin pitch.
  const double way_m =
      -stiffness_Nm_ * std::tan(pitch_rad + pitch_integral_) / (moment_m_kg * base::kGravity_m_s2);
  for (std::size_t i = 0; i < layout_.moving_masses.size(); ++i) {
    const config::LayoutMovingMass& mass = layout_.moving_masses[i];
    const double ahead = vector_of(mass.axis).normalized().x();
    commands.masses_m[i] = std::clamp(ahead < 0 ? -way_m : way_m, mass.low_m, mass.high_m);
  }
}

double speed_of_shaft(double shaft_rps) {
  static const double kAdvance_m = autopilot::surge_for({}, 1);
  return kAdvance_m * shaft_rps;
}

LayoutAutopilot::LayoutAutopilot(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator,
                                 const ControlPlan& plan)
    : vehicle_(vehicle), allocator_(allocator), plan_(plan),
      neutral_(vehicle.hold(ActuatorValues::neutral(vehicle.layout()))), glide_(vehicle) {
  autopilot::Wrench usual = autopilot::Wrench::Zero();
  usual[0] = plan.usual_m_s;
  const Eigen::MatrixXd B = allocator.matrix(usual);
  const Eigen::VectorXd most = most_of(allocator.limits(usual));
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double fastest = i == 2 ? 0.6 : 1.2;
    axes_[static_cast<std::size_t>(i)] =
        AxisControl(std::min(fastest, 0.35 / (lag_of(allocator, B, most, i) + kPeriod_s)));
  }
}

double LayoutAutopilot::speed_demanded(const autopilot::Demand& demand) const {
  return std::clamp(demand.speed_m_s.value_or(speed_of_shaft(demand.shaft_rps)), 0.0, plan_.greatest_m_s);
}

double LayoutAutopilot::pitch_for_depth(double too_deep_m, double surge_m_s, double demanded_m_s,
                                        double period_s) {
  constexpr double kSlowest_m_s = 0.1, kSmallPart = 0.25;
  const double per_s = axes_[4].w_rad_s() / 6;
  const double speed_m_s = std::max({surge_m_s, demanded_m_s / 2, kSlowest_m_s});
  const double by_error = per_s / speed_m_s * too_deep_m;
  if (std::abs(by_error) < kSmallPart * kGreatestPitch_rad) {
    constexpr double kMost_rad = kGreatestPitch_rad / 2;
    depth_integral_rad_ = std::clamp(depth_integral_rad_ + per_s / 6 * by_error * period_s, -kMost_rad, kMost_rad);
  }
  return std::clamp(by_error + depth_integral_rad_, -kGreatestPitch_rad, kGreatestPitch_rad);
}

Vector6 LayoutAutopilot::accelerations(const autopilot::Demand& demand, const Body& body, double period_s,
                                       Attitude& wanted) {
  const Vector6& nu = body.velocity;
  const Vector6 greatest = attainable_.cwiseQuotient(neutral_.mass.diagonal());
  Vector6 acceleration = Vector6::Zero();
  const double speed_m_s = speed_demanded(demand);
  const double error_m_s = speed_m_s - nu[0];
  const double per_s = std::min(0.5, axes_[0].w_rad_s());
  if (!is_thrust_limited_)
    speed_integral_ =
        std::clamp(speed_integral_ + per_s * per_s / 10 * error_m_s * period_s, -greatest[0] / 2, greatest[0] / 2);
  acceleration[0] = per_s * error_m_s + speed_integral_;
  acceleration[1] = -2 * axes_[1].w_rad_s() * nu[1];
  const double too_deep_m = body.position_m.z() - demand.depth_m;
  if (plan_.depth == DepthControl::pitch)
    wanted.pitch_rad = pitch_for_depth(too_deep_m, nu[0], speed_m_s, period_s);
  const auto axis = [&](std::size_t i, double error, double rate, double rate_demanded, double low, double high) {
    const auto at = static_cast<Eigen::Index>(i);
    const double limit = axes_[i].rate_limit(greatest[at], low, high);
    const AxisControl::Demand about{error, rate, rate_demanded, limit, greatest[at]};
    const AxisControl::Wanted next = axes_[i].next(about, period_s);
    acceleration[at] = next.acceleration;
    wanted.velocity[at] = next.rate;
  };
  if (plan_.commanded[2]) {
    const double down_m_s = nu.head<3>().dot(down_of(body.euler_rad));
    axis(2, -too_deep_m, down_m_s, 0, 0.02, 0.5);
  }
  axis(3, -body.euler_rad.x(), nu[3], 0, 0.02, kFastestTurn_rad_s);
  axis(4, wanted.pitch_rad - body.euler_rad.y(), nu[4], 0, 0.02, kFastestTurn_rad_s);
  axis(5, demand.heading_rad - body.euler_rad.z(), turn_rate(body), demand.turn_rad_s, 0.02, kFastestTurn_rad_s);
  wanted.velocity[0] = speed_m_s;
  // Their stability is the vehicle's own: nothing is fed forward for their rates.
  wanted.velocity[3] = wanted.velocity[4] = 0;
  return acceleration;
}

Vector6 LayoutAutopilot::feed_forward(const Attitude& wanted, const Body& body) const {
  const Eigen::Vector3d down(-std::sin(wanted.pitch_rad), 0, std::cos(wanted.pitch_rad));
  const Vector6& nu = body.velocity;
  Vector6 force = -vehicle_.force(wanted.velocity, down, neutral_);
  Vector6 straight = Vector6::Zero();
  straight[0] = nu[0];
  straight[5] = wanted.velocity[5];
  const Vector6 of_straight = vehicle_.force(straight, down, neutral_);
  Vector6 drifting = straight;
  drifting[1] = nu[1];
  drifting[2] = nu[2];
  const Vector6 of_drift = vehicle_.force(drifting, down, neutral_) - of_straight;
  force.tail<3>() = -of_straight.tail<3>();
  if (of_drift[4] * nu[2] * nu[0] > 0) force[4] -= of_drift[4];
  if (of_drift[5] * nu[1] * nu[0] < 0) force[5] -= of_drift[5];
  return force;
}

ActuatorValues LayoutAutopilot::commands(const autopilot::Demand& demand, const Body& body, double period_s) {
  const Eigen::MatrixXd B = allocator_.matrix(body.velocity);
  attainable_ = B.cwiseAbs() * most_of(allocator_.limits(body.velocity));
  Attitude wanted;
  const Vector6 acceleration = accelerations(demand, body, period_s, wanted);
  Vector6 wrench = neutral_.mass.diagonal().cwiseProduct(acceleration) + feed_forward(wanted, body);
  if (demand.rudder_rad) wrench[5] = *demand.rudder_rad / kRudder_rad * attainable_[5];
  if (demand.elevator_rad) wrench[4] = *demand.elevator_rad / kRudder_rad * attainable_[4];
  ActuatorValues commands = ActuatorValues::neutral(vehicle_.layout());
  if (plan_.depth == DepthControl::ballast) glide_.command(demand.depth_m, body, period_s, commands);
  allocate(demand, body, wrench, commands);
  return commands;
}

void LayoutAutopilot::allocate(const autopilot::Demand& demand, const Body& body, const Vector6& wrench,
                               ActuatorValues& commands) {
  autopilot::AllocationRequest request;
  request.wanted = wrench.cwiseMax(-attainable_).cwiseMin(attainable_);
  is_thrust_limited_ = std::abs(wrench[0]) >= attainable_[0];
  request.velocity = body.velocity;
  request.saturation = autopilot::Saturation::least_squares;
  for (std::size_t i = 0; i < 6; ++i)
    request.weights[static_cast<Eigen::Index>(i)] = plan_.commanded[i] ? (i < 3 ? 1 : kAttitude) : 0;
  const autopilot::Allocation allocation = allocator_.allocate(request);
  commands.thrusters = allocation.thruster_commands;
  commands.surfaces_rad = allocation.surfaces_rad;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, commands.surfaces_rad.size()); ++i) {
    if (demand.fins_rad[i]) commands.surfaces_rad[i] = *demand.fins_rad[i];
    last_.fins_rad[static_cast<Eigen::Index>(i)] = commands.surfaces_rad[i];
  }
  const auto part = [&](Eigen::Index i) {
    return attainable_[i] > 0 ? kRudder_rad * allocation.reached[i] / attainable_[i] : 0;
  };
  last_.rudder_rad = part(5);
  last_.elevator_rad = part(4);
  last_.shaft_rps = demand.shaft_rps;
}

LayoutMissionHelm::LayoutMissionHelm(const config::Layout& layout, config::Mission mission)
    : vehicle_(layout), allocator_(layout), steps_(std::move(mission)),
      plan_(plan_control(vehicle_, allocator_, steps_.mission())), autopilot_(vehicle_, allocator_, plan_) {}

void LayoutMissionHelm::next(double /*time_s*/, double step_s, const Body& body, Actuators& actuators) {
  steps_.add_way(body.velocity.head<3>().norm() * step_s);
  // Half a step: the sum of steps is no round number.
  if (until_orders_s_ < 0.5 * step_s) {
    expect_progress();
    const autopilot::Demand& demand = steps_.next(vehicle_state(body), kPeriod_s, autopilot_.last());
    actuators.pulses_us = pulses_of(vehicle_.layout(), autopilot_.commands(demand, body, kPeriod_s));
    until_orders_s_ += kPeriod_s;
  }
  until_orders_s_ -= step_s;
}

std::string LayoutMissionHelm::remark() const {
  const config::Mission& mission = steps_.mission();
  double fastest_m_s = speed_of_shaft(mission.start.shaft_rps);
  for (const config::MissionStep& step : mission.steps) {
    fastest_m_s = std::max(fastest_m_s, step.speed_m_s.value_or(0));
    fastest_m_s = std::max(fastest_m_s, speed_of_shaft(step.shaft_rps.value_or(0)));
  }
  if (!plan_.commanded[0] || fastest_m_s <= plan_.greatest_m_s) return {};
  return fmt::format(
      "{}: speeds are held at {:.2f} m/s, the most that the autopilot trusts this layout with; the mission asks "
      "for up to {:.2f} m/s",
      vehicle_.layout().name, plan_.greatest_m_s, fastest_m_s);
}

void LayoutMissionHelm::expect_progress() const {
  constexpr double kLongest_s = 600, kLeast_m_s = 0.005;
  const std::size_t step = steps_.step();
  if (steps_.finished() || step >= steps_.mission().steps.size() || steps_.since_s() < kLongest_s) return;
  const auto& metres = steps_.mission().steps[step].metres;
  if (!metres || steps_.way_m() > kLeast_m_s * steps_.since_s()) return;
  throw UnfitLayout(fmt::format("{}: {} of the mission does not end: {:.2f} of {:g} m in {:.0f} s",
                                vehicle_.layout().name, step_words(steps_.mission(), step), steps_.way_m(),
                                *metres, steps_.since_s()));
}

}  // namespace navcal::sim
