// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/simulated_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "autopilot/autopilot.h"
#include "sim/rotation.h"
#include "tests/sim/vehicle/runs.h"

namespace navcal::sim::testing {
namespace {

constexpr std::string_view kWeave = R"(
start.speed_m_s = 1.1
step = [{do = "zigzag", rudder_deg = 15, reach_deg = 30, times = 3}, {do = "dive", depth_m = 2}, {do = "leg", seconds = 5}]
)";

TEST(SimulatedMotion, IsTheSameInWhateverOrderItIsAsked) {
  const auto forwards = on_mission(kWeave);
  const auto backwards = on_mission(kWeave);
  std::vector<State> there;
  for (int i = 0; i <= 100; ++i) there.push_back(forwards.at(at_s(0.237 * i)));
  for (int i = 100; i >= 0; --i) {
    const State back = backwards.at(at_s(0.237 * i));
    ASSERT_EQ(back.position_m, there[static_cast<std::size_t>(i)].position_m);
    ASSERT_EQ(back.specific_force_m_s2, there[static_cast<std::size_t>(i)].specific_force_m_s2);
  }
}

TEST(SimulatedMotion, OrdersAreTakenOnceAndTheServosFollowThem) {
  const auto motion = on_mission(kWeave);
  std::vector<Order> orders;
  for (int i = 1; i <= 40; ++i) motion.take_orders(at_s(0.5 * i), orders);
  ASSERT_GT(orders.size(), 50U);
  constexpr double kLag_s = 0.15, kTenth_rad = 0.1 * std::numbers::pi / 180;
  Vector3 servo_rad{}, command_rad{};
  std::int64_t at_ns = at_s(0);
  for (const Order& order : orders) {
    EXPECT_GE(order.time_ns, at_ns);
    EXPECT_LE(order.time_ns, at_s(20));
    const double kept = std::exp(-1e-9 * static_cast<double>(order.time_ns - at_ns) / kLag_s);
    const State state = motion.at(order.time_ns);
    for (std::size_t i = 0; i < 3; ++i) {
      servo_rad[i] = command_rad[i] + (servo_rad[i] - command_rad[i]) * kept;
      EXPECT_NEAR(state.fins_rad[i], servo_rad[i], 1e-9) << order.time_ns - at_s(0);
      EXPECT_NEAR(std::remainder(order.fins_rad[i], kTenth_rad), 0, 1e-12) << "the card takes tenths";
    }
    command_rad = order.fins_rad;
    at_ns = order.time_ns;
  }
  const std::size_t before = orders.size();
  motion.take_orders(at_s(20), orders);
  EXPECT_EQ(orders.size(), before);
}

TEST(SimulatedMotion, WhatItSaysOfMotionFitsTogether) {
  const auto motion = on_mission(kWeave);
  constexpr double kHalf_s = 0.01;
  for (double t = 1; t < 20; t += 0.113) {
    const State before = motion.at(at_s(t - kHalf_s)), now = motion.at(at_s(t)),
                after = motion.at(at_s(t + kHalf_s));
    const Vector3 velocity = R_world_from_body(now.euler_rad) * now.velocity_body_m_s;
    Vector3 turn{}, change{};
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_NEAR((after.position_m[i] - before.position_m[i]) / (2 * kHalf_s), velocity[i], 1e-3) << t;
      turn[i] = (after.euler_rad[i] - before.euler_rad[i]) / (2 * kHalf_s);
      change[i] = (after.velocity_body_m_s[i] - before.velocity_body_m_s[i]) / (2 * kHalf_s);
    }
    const Vector3 rates = body_rates(now.euler_rad, turn);
    const Vector3 force = specific_force(now.euler_rad, now.velocity_body_m_s, now.rate_rad_s, change);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_NEAR(rates[i], now.rate_rad_s[i], 5e-3) << t;
      ASSERT_NEAR(force[i], now.specific_force_m_s2[i], 0.03) << t;
    }
  }
}

/// A rudder that moves evenly.
struct RampHelm final : Helm {
  static Eigen::Vector3d fins_rad(double time_s) { return autopilot::mixed_fins(0.2 * time_s, 0); }
  [[nodiscard]] Body start() const override { return under_way(1.1); }
  [[nodiscard]] ActuatorValues positions_at_start() const override { return Controls{fins_rad(0), 13}.values(); }
  [[nodiscard]] Positions positions() const override { return Positions::written; }
  void next(double time_s, double step_s, const Body&, Actuators& actuators) override {
    actuators.positions = Controls{fins_rad(time_s + step_s), 13}.values();
  }
  [[nodiscard]] bool finished() const override { return false; }
};

TEST(SimulatedMotion, FinsThatMoveAreFeltWhenTheyMoveAndNotHalfAStepEarlier) {
  const SimulatedMotion motion(config::VehicleSettings{}, std::make_unique<RampHelm>(), {});
  const LayoutVehicle vehicle(layout_of({}));
  constexpr double kFine_s = 1e-4, kUntil_s = 1;
  Body body = under_way(1.1);
  for (int i = 0; i < std::lround(kUntil_s / kFine_s); ++i) {
    const Controls held{RampHelm::fins_rad((i + 0.5) * kFine_s), 13};
    body = vehicle.step(body, held.values(), kFine_s).body;
  }
  const double rate_rad_s = motion.at(at_s(kUntil_s)).rate_rad_s[2];
  const double rising_rad_s2 = (rate_rad_s - motion.at(at_s(kUntil_s - 0.1)).rate_rad_s[2]) / 0.1;
  EXPECT_GT(std::abs(rising_rad_s2), 0.1);
  EXPECT_NEAR(rate_rad_s, body.velocity[5], 1e-4 * std::abs(rising_rad_s2));  // a tenth of a millisecond
}

TEST(SimulatedMotion, BeginsWhenItIsToldAndIsStillBefore) {
  const auto motion = on_mission(kWeave, {.start_ns = at_s(1000)});
  EXPECT_EQ(motion.at(0).position_m, motion.at(at_s(1000)).position_m);
  EXPECT_GT(motion.at(at_s(1010)).position_m[0], 5);
}

TEST(SimulatedMotion, KeepsOnlyAsMuchAsItIsTold) {
  const auto all = on_mission(kWeave);
  const auto some = on_mission(kWeave, {.history_s = 5});
  EXPECT_EQ(some.at(at_s(60)).position_m, all.at(at_s(60)).position_m);
  EXPECT_EQ(some.at(at_s(56)).position_m, all.at(at_s(56)).position_m);
  EXPECT_NEAR(some.at(at_s(10)).position_m[0], all.at(at_s(55)).position_m[0], 0.1) << "the oldest there is";
}

TEST(SimulatedMotion, StateSaysWhatTheMotorDrawsAndHowWarmTheWaterIs) {
  const auto motion = on_mission("start.depth_m = 8\nstep = [{do = \"leg\", seconds = 1}]\n");
  EXPECT_NEAR(motion.at(at_s(5)).motor_current_A, 0.15 + 5.5e-4 * 13 * 13 * 13, 1e-9);
  EXPECT_NEAR(motion.at(at_s(5)).water_temperature_C, 13, 0.05);
}

/// Writes down when it was asked, turns all fins, and lets a current run.
struct Watcher final : VehicleInfluencer {
  std::vector<double> influenced, linked;
  void influence(double time_s, Influences& on) override {
    influenced.push_back(time_s);
    on.current_m_s = {0, 0.5};
  }
  void link_fins(double time_s, double step_s, Vector3& fins_rad) override {
    linked.push_back(time_s);
    EXPECT_DOUBLE_EQ(step_s, 0.01);
    fins_rad = {-0.1, 0.05, 0.05};
  }
};

TEST(SimulatedMotion, AsksWhoeverChangesTheVehicleOnceAStepInOrder) {
  Watcher watcher;
  const auto motion = on_mission("step = [{do = \"direct\", rudder_deg = 0, elevator_deg = 0, seconds = 20}]\n",
                                 {.influencer = &watcher});
  const State state = motion.at(at_s(10));
  static_cast<void>(motion.at(at_s(3)));
  ASSERT_EQ(watcher.influenced.size(), 1002U) << "once for each step up to the one after";
  ASSERT_EQ(watcher.linked.size(), watcher.influenced.size());
  for (std::size_t i = 0; i < watcher.linked.size(); ++i) {
    ASSERT_NEAR(watcher.influenced[i], 0.01 * static_cast<double>(i), 1e-9);
    ASSERT_NEAR(watcher.linked[i], 0.01 * static_cast<double>(i + 1), 1e-9);
  }
  EXPECT_GT(state.euler_rad[2], 0.5) << "the fins turned ...";
  EXPECT_NEAR(state.fins_rad[0], 0, 1e-9) << "... and the servos did not";
  EXPECT_DOUBLE_EQ(state.current_m_s[1], 0.5);
}

TEST(SimulatedMotion, AVehicleThatStandsOnItsTailIsSaidToDoSo) {
  const auto motion = on_mission(
      "step = [{do = \"leg\", seconds = 10}, {do = \"direct\", elevator_deg = 25, shaft_rpm = 1800, seconds = "
      "60}]\n");
  try {
    static_cast<void>(motion.duration_s());
    FAIL() << "it went on";
  } catch (const UnstableVehicle& error) {
    EXPECT_NE(std::string(error.what()).find("at t = 1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace navcal::sim::testing
