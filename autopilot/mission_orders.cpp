// SPDX-License-Identifier: Apache-2.0
#include "autopilot/mission_orders.h"

#include <numbers>
#include <utility>

#include "base/rounding.h"

namespace navcal::autopilot {
namespace {

/// The motor card takes tenths of a degree (its interface document, section 4).
constexpr double kOrdered_rad = 0.1 * std::numbers::pi / 180;

}  // namespace

MissionSteps::MissionSteps(config::Mission mission) : mission_(std::move(mission)) {
  demand_.heading_rad = mission_.start.heading_rad;
  demand_.depth_m = mission_.start.depth_m;
  demand_.shaft_rps = mission_.start.shaft_rps;
}

const Demand& MissionSteps::next(const VehicleState& state, double period_s, const Orders& last) {
  situation_.since_s += period_s;
  situation_.period_s = period_s;
  situation_.state = state;
  situation_.last = last;
  if (!manoeuvre_ && step_ < mission_.steps.size()) begin_step();
  if (manoeuvre_ && !manoeuvre_->go_on(situation_, demand_)) end_step();
  now_s_ += period_s;
  return demand_;
}

void MissionSteps::begin_step() {
  const config::MissionStep& step = mission_.steps[step_];
  if (step.shaft_rps) {
    demand_.shaft_rps = *step.shaft_rps;
    demand_.speed_m_s.reset();
  }
  if (step.speed_m_s) demand_.speed_m_s = step.speed_m_s;
  manoeuvre_ = make_manoeuvre(step);
  situation_.since_s = 0;
  situation_.way_m = 0;
  manoeuvre_->begin(situation_, demand_);
}

void MissionSteps::end_step() {
  manoeuvre_.reset();
  // After a step with free rudder the autopilot keeps the present heading.
  if (demand_.rudder_rad || demand_.fins_rad[0]) demand_.heading_rad = situation_.state.euler_rad[2];
  demand_.turn_rad_s = 0;
  demand_.rudder_rad.reset();
  demand_.elevator_rad.reset();
  demand_.fins_rad = {};
  if (++step_ < mission_.steps.size()) {
    if (!finished_) began_s_.push_back(now_s_);
    return;
  }
  finished_ = true;
  if (mission_.at_end == config::MissionEnd::repeat) step_ = 0;
}

MissionOrders::MissionOrders(const config::VehicleSettings& vehicle, config::Mission mission)
    : steps_(std::move(mission)), autopilot_(vehicle) {
  orders_.shaft_rps = steps_.mission().start.shaft_rps;
}

const Orders& MissionOrders::next(const VehicleState& state, double period_s) {
  orders_ = autopilot_.orders(steps_.next(state, period_s, orders_), state, period_s);
  for (double& fin : orders_.fins_rad) fin = base::rounded(fin, kOrdered_rad);
  return orders_;
}

}  // namespace navcal::autopilot
