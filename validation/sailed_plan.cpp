// SPDX-License-Identifier: Apache-2.0
#include "validation/sailed_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/missions.h"
#include "validation/reference/instrument.h"

namespace navcal::validation {
namespace {

using reference::kDegree;
using reference::Order;

constexpr double kStart_m = 0.15;
/// A ramp of heading or depth is ordered in steps of so many seconds.
constexpr double kRamp_s = 0.5;
/// What a vehicle of this size does at a metre a second.
constexpr double kDiveRate_m_s = 0.2, kDive_s = 6, kTurnRate_rad_s = 15 * kDegree;

class PlanOrders {
 public:
  explicit PlanOrders(const config::Mission& steps) {
    mission_.start.position_m = {0, 0, steps.start.depth_m};
    mission_.start.world_from_body = reference::attitude(0, 0, steps.start.heading_rad);
    order_.heading_rad = steps.start.heading_rad;
    order_.depth_m = steps.start.depth_m;
    order_.shaft_rev_s = steps.start.shaft_rps;
  }

  void take(const config::MissionStep& step) {
    if (step.shaft_rps) order_.shaft_rev_s = *step.shaft_rps;
    switch (step.kind) {
      case config::StepKind::turn:
      case config::StepKind::circle:
      case config::StepKind::pirouette:
        return turn(angle_of(step), step.rate_rad_s.value_or(kTurnRate_rad_s), *order_.depth_m);
      case config::StepKind::spiral:
        return turn(angle_of(step), step.rate_rad_s.value_or(kTurnRate_rad_s),
                    step.depth_m.value_or(*order_.depth_m));
      case config::StepKind::zigzag: return zigzag(step);
      case config::StepKind::dive:
      case config::StepKind::surface: return depth(step.depth_m.value_or(kStart_m), step.seconds.value_or(0));
      case config::StepKind::doublet: return doublet(step);
      case config::StepKind::direct: return direct(step);
      default:
        if (step.heading_rad) order_.heading_rad = *step.heading_rad;
        if (step.depth_m) order_.depth_m = *step.depth_m;
        return hold(step.seconds.value_or(step.metres.value_or(10)));
    }
  }

  reference::Mission finish(double most_s) && {
    mission_.duration_s = std::min(now_s_, most_s);
    mission_.start_ns = kTrialBegin_ns;
    return std::move(mission_);
  }

 private:
  void give(const Order& order, double seconds) {
    mission_.orders.push_back(order);
    mission_.orders.back().from_s = now_s_;
    now_s_ += seconds;
  }
  void hold(double seconds) { give(order_, seconds); }

  static double angle_of(const config::MissionStep& step) {
    if (step.turns) return 2 * std::numbers::pi * *step.turns;
    return step.by_rad.value_or(std::numbers::pi / 2);
  }
  void turn(double angle_rad, double rate_rad_s, double depth_m) {
    const int parts = std::max(1, static_cast<int>(std::abs(angle_rad) / rate_rad_s / kRamp_s));
    const double from_m = *order_.depth_m;
    for (int i = 1; i <= parts; ++i) {
      order_.heading_rad = *order_.heading_rad + angle_rad / parts;
      order_.depth_m = from_m + (depth_m - from_m) * i / parts;
      hold(kRamp_s);
    }
  }
  void zigzag(const config::MissionStep& step) {
    const double rudder_rad = step.rudder_rad.value_or(10 * kDegree);
    const double seconds = 2 * step.reach_rad.value_or(20 * kDegree) / kTurnRate_rad_s;
    for (int i = 0; i < step.times.value_or(4); ++i) {
      Order order = order_;
      order.heading_rad.reset();
      order.rudder_rad = i % 2 == 0 ? rudder_rad : -rudder_rad;
      give(order, i == 0 ? seconds / 2 : seconds);
    }
  }
  void depth(double depth_m, double seconds) {
    const double way_s = kDive_s + std::abs(depth_m - *order_.depth_m) / kDiveRate_m_s;
    order_.depth_m = depth_m;
    hold(way_s + seconds);
  }
  void doublet(const config::MissionStep& step) {
    const double amplitude_rad = step.amplitude_rad.value_or(5 * kDegree), seconds = step.seconds.value_or(2);
    for (int i = 0; i < 2 * step.times.value_or(1); ++i) {
      Order order = order_;
      const double angle_rad = i % 2 == 0 ? amplitude_rad : -amplitude_rad;
      if (step.on == config::Surface::rudder) {
        order.heading_rad.reset();
        order.rudder_rad = angle_rad;
      } else if (step.on == config::Surface::elevator) {
        order.depth_m.reset();
        order.elevator_rad = angle_rad;
      } else {
        order.fins_beside_rad[static_cast<Eigen::Index>(step.on) -
                              static_cast<Eigen::Index>(config::Surface::fin1)] = angle_rad;
      }
      give(order, seconds);
    }
  }
  void direct(const config::MissionStep& step) {
    Order order = order_;
    order.heading_rad.reset();
    order.depth_m.reset();
    order.rudder_rad = step.rudder_rad.value_or(0);
    order.elevator_rad = step.elevator_rad.value_or(0);
    give(order, step.seconds.value_or(5));
  }

  reference::Mission mission_;
  Order order_;
  double now_s_ = 0;
};

}  // namespace

reference::Mission sailed_plan(const config::Mission& steps, double most_s) {
  PlanOrders orders(steps);
  for (const config::MissionStep& step : steps.steps) orders.take(step);
  return std::move(orders).finish(most_s);
}

reference::Mission random_manoeuvres(double seconds, reference::Rng& dice) {
  reference::Mission mission;
  mission.start_ns = kTrialBegin_ns;
  mission.start.position_m = {0, 0, kStart_m};
  mission.start.world_from_body = reference::attitude(0, 0, 0);
  mission.duration_s = seconds;
  Order order;
  order.heading_rad = 0.0;
  order.depth_m = kStart_m;
  order.speed_m_s = 1.0;
  for (double now_s = 0; now_s < seconds; now_s += dice.uniform(4, 10)) {
    order.from_s = now_s;
    order.heading_rad.reset();
    order.rudder_rad = 0;
    if (dice.uniform(0, 1) < 0.5) {
      order.heading_rad = dice.uniform(0, 2 * std::numbers::pi);
    } else {
      order.rudder_rad = dice.uniform(-12, 12) * kDegree;
    }
    order.depth_m = dice.uniform(kStart_m, 2.5);
    order.speed_m_s = dice.uniform(0.8, 1.3);
    mission.orders.push_back(order);
  }
  return mission;
}

}  // namespace navcal::validation
