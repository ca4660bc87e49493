// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/mission_helm.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/noise.h"

namespace navcal::sim {
namespace {

/// The motor card takes tenths of a degree (its interface document, section 4).
constexpr double kOrdered_rad = 0.1 * std::numbers::pi / 180;

std::unique_ptr<Manoeuvre> make_manoeuvre(const config::MissionStep& step) {
  using config::StepKind;
  switch (step.kind) {
    case StepKind::leg:
    case StepKind::dive:
    case StepKind::surface:
    case StepKind::speed:
      return make_steady_manoeuvre(step);
    case StepKind::turn:
    case StepKind::circle:
    case StepKind::spiral:
    case StepKind::swing:
      return make_turning_manoeuvre(step);
    case StepKind::zigzag:
    case StepKind::pirouette:
    case StepKind::doublet:
    case StepKind::direct:
      break;
  }
  return make_rudder_manoeuvre(step);
}

}  // namespace

MissionHelm::MissionHelm(const config::VehicleSettings& vehicle, config::Mission mission)
    : vehicle_(vehicle), mission_(std::move(mission)), autopilot_(vehicle) {
  demand_.heading_rad = mission_.start.heading_rad;
  demand_.depth_m = mission_.start.depth_m;
  demand_.shaft_rps = orders_.shaft_rps = mission_.start.shaft_rps;
  actuators_ = actuators_at_start();
}

Body MissionHelm::start() const {
  Body body;
  body.position_m.z() = mission_.start.depth_m;
  body.euler_rad.z() = mission_.start.heading_rad;
  body.velocity[0] = mission_.start.speed_m_s;
  return body;
}

Actuators MissionHelm::actuators_at_start() const {
  return {Eigen::Vector3d::Zero(), mission_.start.shaft_rps, mission_.start.shaft_rps};
}

Actuators MissionHelm::next(double /*time_s*/, double step_s, const Body& body) {
  situation_.way_m += body.velocity.head<3>().norm() * step_s;
  actuators_.fins_ordered_rad.reset();
  // Half a step: the sum of steps is no round number.
  if (until_orders_s_ < 0.5 * step_s) {
    const Orders before = orders_;
    give_orders(body);
    if (orders_.fins_rad != before.fins_rad || orders_.shaft_rps != before.shaft_rps) {
      actuators_.fins_ordered_rad = orders_.fins_rad;
    }
    until_orders_s_ += vehicle_.autopilot.period_s;
  }
  until_orders_s_ -= step_s;
  const double limit = vehicle_.fins.limit_rad;
  const double fin_part = 1 - std::exp(-step_s / vehicle_.fins.lag_s);
  actuators_.fins_rad += fin_part * (orders_.fins_rad - actuators_.fins_rad);
  actuators_.fins_rad = actuators_.fins_rad.cwiseMax(-limit).cwiseMin(limit);
  actuators_.shaft_rps +=
      (1 - std::exp(-step_s / vehicle_.propeller.lag_s)) * (orders_.shaft_rps - actuators_.shaft_rps);
  actuators_.shaft_commanded_rps = orders_.shaft_rps;
  return actuators_;
}

void MissionHelm::give_orders(const Body& body) {
  situation_.body = body;
  situation_.last = orders_;
  situation_.period_s = vehicle_.autopilot.period_s;
  if (!manoeuvre_ && step_ < mission_.steps.size()) begin_step(situation_);
  if (manoeuvre_ && !manoeuvre_->go_on(situation_, demand_)) end_step(body);
  orders_ = autopilot_.orders(demand_, body);
  for (double& fin : orders_.fins_rad) fin = rounded(fin, kOrdered_rad);
  situation_.since_s += situation_.period_s;
}

void MissionHelm::begin_step(const Situation& now) {
  const config::MissionStep& step = mission_.steps[step_];
  if (step.shaft_rps) {
    demand_.shaft_rps = *step.shaft_rps;
    demand_.speed_m_s.reset();
  }
  if (step.speed_m_s) demand_.speed_m_s = step.speed_m_s;
  manoeuvre_ = make_manoeuvre(step);
  situation_.since_s = 0;
  situation_.way_m = 0;
  manoeuvre_->begin(now, demand_);
}

void MissionHelm::end_step(const Body& body) {
  manoeuvre_.reset();
  // From free rudder the autopilot takes over the heading that it finds.
  if (demand_.rudder_rad || demand_.fins_rad[0]) demand_.heading_rad = body.euler_rad.z();
  demand_.turn_rad_s = 0;
  demand_.rudder_rad.reset();
  demand_.elevator_rad.reset();
  demand_.fins_rad = {};
  if (++step_ < mission_.steps.size()) return;
  finished_ = true;
  if (mission_.at_end == config::MissionEnd::repeat) step_ = 0;
}

}  // namespace navcal::sim
