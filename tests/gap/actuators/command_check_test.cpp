// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/command_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "gap/actuators/commanded_motor.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

using test::simulated_mission;

void shift(Mission& mission, double earlier_s) {
  for (Order& order : mission.orders) order.time_s -= earlier_s;
  for (double& time_s : mission.commanded_s) time_s -= earlier_s;
}

TEST(CommandedMotor, FollowsWithTheLagsOfServoAndShaft) {
  const config::VehicleSettings vehicle;
  const std::vector<Order> orders{{10, 0, {0, 0, 0}}, {11, 600, {0.1, -0.1, 0.2}}};
  const auto reports = commanded_motor(orders, vehicle, 20);
  ASSERT_GT(reports.size(), 90U);
  EXPECT_EQ(reports.front().time_s, 10);
  const auto at = [&](double time_s) {
    return *std::find_if(reports.begin(), reports.end(),
                         [&](const MotorReading& reading) { return reading.time_s > time_s - 1e-6; });
  };
  EXPECT_EQ(at(10.9).fins_rad[2], 0);
  EXPECT_NEAR(at(11.3).fins_rad[2], 0.2 * (1 - std::exp(-0.3 / vehicle.fins.lag_s)), 1e-9);
  EXPECT_NEAR(at(11.5).rpm, 600 * (1 - std::exp(-0.5 / vehicle.propeller.lag_s)), 1e-6);
  EXPECT_NEAR(reports.back().fins_rad[1], -0.1, 1e-9);
  EXPECT_TRUE(std::isnan(reports.back().current_A));
  EXPECT_TRUE(commanded_motor({}, vehicle, 20).empty());
}

TEST(CommandedMotor, IsNearWhatTheCardReports) {
  const Mission whole = simulated_mission("identification", "", 100, 2);
  Mission mission = whole;
  obey_orders(mission, {});
  EXPECT_FALSE(mission.motor_is_commanded) << "reports are better than commands";
  mission.motor.clear();
  obey_orders(mission, {});
  ASSERT_TRUE(mission.motor_is_commanded);
  double square = 0;
  int count = 0;
  for (const MotorReading& reading : whole.motor) {
    const auto place = std::lround((reading.time_s - mission.motor.front().time_s) / 0.1);
    if (place < 50 || place >= static_cast<long>(mission.motor.size())) continue;
    const double off = reading.fins_rad[1] - mission.motor[static_cast<std::size_t>(place)].fins_rad[1];
    square += off * off;
    ++count;
  }
  ASSERT_GT(count, 500);
  EXPECT_LT(std::sqrt(square / count), 2 * base::kRadiansPerDegree);
}

TEST(CommandCheck, ReportsTellTheDelayOfCommands) {
  const Mission prompt = simulated_mission("identification", "", 120, 2);
  const CommandCheck check = check_commands(prompt, {});
  ASSERT_TRUE(check.delay_s);
  EXPECT_TRUE(check.by_reports);
  EXPECT_NEAR(*check.delay_s, 0, 0.05);
  EXPECT_EQ(check.saturated, 0);
  EXPECT_EQ(check.unrecorded, 0);
  for (const double late_s : {0.4, 1.5, -0.5}) {
    Mission late = prompt;
    shift(late, late_s);
    const auto found = check_commands(late, {}).delay_s;
    ASSERT_TRUE(found) << late_s;
    EXPECT_NEAR(*found, late_s, 0.06);
  }
}

TEST(CommandCheck, TurnsTellTheDelayOfCommandsThatNothingReports) {
  Mission prompt = simulated_mission("identification", "", 200, 2);
  prompt.motor.clear();
  for (const double late_s : {0.0, 1.0}) {
    Mission late = prompt;
    shift(late, late_s);
    obey_orders(late, {});
    const CommandCheck check = check_commands(late, {});
    EXPECT_FALSE(check.by_reports);
    ASSERT_TRUE(check.delay_s) << late_s;
    EXPECT_NEAR(*check.delay_s, late_s, 0.2);
  }
}

TEST(CommandCheck, CommandsOfAnotherMissionHaveNoDelay) {
  Mission mission = simulated_mission("identification", "", 200, 2);
  mission.orders = simulated_mission("survey", "", 200, 5).orders;
  const CommandCheck check = check_commands(mission, {});
  EXPECT_FALSE(check.delay_s);
  EXPECT_LT(check.correlation.value_or(0), 0.6);
}

TEST(CommandCheck, SharesOfTheTimeAreStated) {
  Mission mission = simulated_mission("identification", "", 120, 2);
  // From 60 s on no command is recorded, and the fins go on moving.
  std::erase_if(mission.orders, [](const Order& order) { return order.time_s > 60; });
  std::erase_if(mission.commanded_s, [](double time_s) { return time_s > 60; });
  EXPECT_NEAR(check_commands(mission, {}).unrecorded, 0.5, 0.03);

  mission.orders = {{0, 700, {0, 0, 0}}, {30, 700, {0.44, 0, 0}}};
  EXPECT_NEAR(check_commands(mission, {}).saturated, 0.75, 0.01);
  mission.orders.clear();
  for (std::size_t i = 0; i < mission.motor.size() / 4; ++i) mission.motor[i].fins_rad[1] = -0.436;
  EXPECT_NEAR(check_commands(mission, {}).saturated, 0.25, 0.01);
}

}  // namespace
}  // namespace navcal::gap
