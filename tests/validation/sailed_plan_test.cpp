// SPDX-License-Identifier: Apache-2.0
#include "validation/sailed_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "config/mission_file.h"

namespace navcal::validation {
namespace {

reference::Mission sailed(const std::string& steps, double most_s = 1000) {
  return sailed_plan(config::parse_mission("start.shaft_rpm = 780\nstep = [\n" + steps + "]\n", "plan.toml"),
                     most_s);
}

TEST(SailedPlan, TurnsACircleInTheTimeThatItsRateTakes) {
  const auto mission = sailed("{do = \"circle\", turns = -1, rate_deg_s = 20}");
  EXPECT_NEAR(mission.duration_s, 18, 1);
  EXPECT_NEAR(*mission.orders.back().heading_rad, -2 * std::numbers::pi, 1e-9);
}

TEST(SailedPlan, MovesOneSurfaceThereAndBack) {
  const auto mission = sailed("{do = \"doublet\", on = \"fin2\", amplitude_deg = 3, seconds = 1, times = 2}");
  ASSERT_EQ(mission.orders.size(), 4U);
  EXPECT_NEAR(mission.orders[0].fins_beside_rad[1], 3 * std::numbers::pi / 180, 1e-12);
  EXPECT_NEAR(mission.orders[1].fins_beside_rad[1], -3 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(mission.orders[0].fins_beside_rad[0], 0);
  const auto rudder = sailed("{do = \"doublet\", on = \"rudder\", amplitude_deg = 5, seconds = 2}");
  EXPECT_FALSE(rudder.orders.front().heading_rad);
}

TEST(SailedPlan, EndsWhenItsTimeIsOver) {
  EXPECT_EQ(sailed("{do = \"leg\", heading_deg = 90, seconds = 500}", 180).duration_s, 180);
}

TEST(SailedPlan, HasOrdersInOrderOfTimeForEachKindOfStep) {
  const auto mission = sailed(
      "{do = \"surface\", seconds = 5}, {do = \"dive\", depth_m = 2}, {do = \"speed\", shaft_rpm = 600, seconds = "
      "4},\n"
      "{do = \"zigzag\", rudder_deg = 10, reach_deg = 20, times = 3}, {do = \"spiral\", turns = 1, depth_m = 1},\n"
      "{do = \"direct\", rudder_deg = 0, elevator_deg = 0, shaft_rpm = 0, seconds = 5}");
  double before_s = -1;
  for (const reference::Order& order : mission.orders) {
    EXPECT_GT(order.from_s, before_s);
    before_s = order.from_s;
  }
  EXPECT_EQ(mission.orders.back().shaft_rev_s, 0);
}

TEST(RandomManoeuvres, StayWithinDepthsAndTime) {
  reference::Rng dice(3, 1);
  const auto mission = random_manoeuvres(180, dice);
  EXPECT_EQ(mission.duration_s, 180);
  EXPECT_GT(mission.orders.size(), 15U);
  for (const reference::Order& order : mission.orders) {
    EXPECT_LE(*order.depth_m, 2.5);
    EXPECT_LT(order.from_s, 180);
  }
}

}  // namespace
}  // namespace navcal::validation
