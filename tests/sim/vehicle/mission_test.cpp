// SPDX-License-Identifier: Apache-2.0
// Each kind of step does what it is for; the shipped missions can be sailed.
#include <gtest/gtest.h>

#include <string>

#include "tests/sim/vehicle/runs.h"

namespace navcal::sim::testing {
namespace {

SimulatedMotion steps(const std::string& steps) {
  return on_mission("mission.at_end = \"hold\"\nstart.speed_m_s = 1.1\nstart.depth_m = 1\nstep = [" + steps +
                    "]\n");
}

State end_of(const SimulatedMotion& motion) { return motion.at(at_s(motion.duration_s())); }

double rudder_deg(const State& state) {
  return 2.0 / 3 * ((state.fins_rad[1] + state.fins_rad[2]) / 2 - state.fins_rad[0]) * kDegrees;
}

TEST(Mission, ALegTakesItsTimeOrItsWay) {
  EXPECT_NEAR(steps("{do = \"leg\", seconds = 12.5}").duration_s(), 12.5, 0.11);
  EXPECT_NEAR(end_of(steps("{do = \"leg\", metres = 20}")).position_m[0], 20, 0.2);
}

TEST(Mission, ATurnGoesTheShorterWayToAHeadingAndAsFarAsItIsToldByAnAngle) {
  EXPECT_NEAR(
      end_of(steps("{do = \"turn\", heading_deg = 300}, {do = \"leg\", seconds = 5}")).euler_rad[2] * kDegrees,
      -60, 1);
  EXPECT_NEAR(end_of(steps("{do = \"turn\", by_deg = 300}, {do = \"leg\", seconds = 5}")).euler_rad[2] * kDegrees,
              300, 1);
}

TEST(Mission, ACircleKeepsItsRateAndItsDepth) {
  const auto motion = steps("{do = \"circle\", turns = -2, rate_deg_s = 20}");
  EXPECT_NEAR(motion.duration_s(), 36, 1);
  const double turned = motion.at(at_s(30)).euler_rad[2] - motion.at(at_s(20)).euler_rad[2];
  EXPECT_NEAR(turned * kDegrees, -200, 5);
  EXPECT_NEAR(end_of(motion).position_m[2], 1, 0.1);
}

TEST(Mission, ASpiralSinksAsItTurns) {
  const auto motion = steps("{do = \"spiral\", turns = 3, rate_deg_s = 20, depth_m = 4}");
  const State half = motion.at(at_s(motion.duration_s() / 2));
  EXPECT_NEAR(half.position_m[2], 2.5, 0.5);
  EXPECT_NEAR(half.euler_rad[2] * kDegrees, 540, 30);
  EXPECT_NEAR(end_of(motion).position_m[2], 4, 0.4);
}

TEST(Mission, AZigzagPutsTheRudderOverWhereTheHeadingHasGoneFarEnough) {
  const auto motion = steps("{do = \"zigzag\", rudder_deg = 15, reach_deg = 20, times = 4}");
  double greatest = 0, least = 0;
  for (double t = 0; t < motion.duration_s(); t += 0.1) {
    greatest = std::max(greatest, motion.at(at_s(t)).euler_rad[2] * kDegrees);
    least = std::min(least, motion.at(at_s(t)).euler_rad[2] * kDegrees);
  }
  EXPECT_GT(greatest, 20);
  EXPECT_LT(greatest, 40) << "it overshoots, but not for ever";
  EXPECT_LT(least, -20);
  EXPECT_GT(least, -40);
}

TEST(Mission, APirouetteTurnsWithOneRudder) {
  const auto motion = steps("{do = \"pirouette\", turns = -2, rudder_deg = 20}");
  EXPECT_NEAR(rudder_deg(motion.at(at_s(5))), -20, 0.5);
  EXPECT_NEAR(end_of(motion).euler_rad[2] * kDegrees, -720, 15);
}

TEST(Mission, DivingAndSurfacing) {
  const auto motion = steps("{do = \"dive\", depth_m = 3}, {do = \"surface\", seconds = 20}");
  double deepest = 0, shallow_s = 0;
  for (double t = 0; t < motion.duration_s(); t += 0.1) {
    const double depth_m = motion.at(at_s(t)).position_m[2];
    deepest = std::max(deepest, depth_m);
    if (depth_m < 0.35) shallow_s += 0.1;
  }
  EXPECT_NEAR(deepest, 3, 0.3);
  EXPECT_GE(shallow_s, 20) << "GPS is heard above 0.35 m";
}

TEST(Mission, ASwingHoldsItsStationsAllRound) {
  const auto motion = steps("{do = \"swing\", stations = 4, seconds = 10, rate_deg_s = 30}");
  // 10 s and then 3 s to the next.
  for (int station = 0; station < 4; ++station) {
    EXPECT_NEAR(motion.at(at_s(9.5 + 13.2 * station)).euler_rad[2] * kDegrees, 90 * station, 3) << station;
  }
  EXPECT_NEAR(motion.duration_s(), 4 * 10 + 3 * 3, 2);
}

TEST(Mission, ASpeedStepAndWhatIsHeldAfterIt) {
  const auto motion = steps("{do = \"speed\", shaft_rpm = 960, seconds = 20}, {do = \"leg\", seconds = 10}");
  EXPECT_NEAR(end_of(motion).rpm, 960, 0.1);
  EXPECT_NEAR(end_of(motion).velocity_body_m_s[0], 1.395, 0.01);
  EXPECT_DOUBLE_EQ(motion.at(at_s(1)).rpm_commanded, 960);
  EXPECT_NEAR(motion.at(at_s(0.5)).rpm, 780 + 180 * (1 - std::exp(-1)), 3) << "the shaft's lag is 0.5 s";
}

TEST(Mission, ADoubletGoesOutOverAndBack) {
  const auto motion = steps("{do = \"doublet\", on = \"rudder\", amplitude_deg = 8, seconds = 2, times = 2}");
  EXPECT_NEAR(motion.duration_s(), 8, 0.15);
  for (const auto& [time_s, rudder] : {std::pair{1.9, 8.0}, {3.9, -8.0}, {5.9, 8.0}, {7.9, -8.0}}) {
    EXPECT_NEAR(rudder_deg(motion.at(at_s(time_s))), rudder, 0.1) << time_s;
  }
}

TEST(Mission, ADoubletOfOneFinLeavesTheOthersAlone) {
  const auto motion =
      steps("{do = \"leg\", seconds = 10}, {do = \"doublet\", on = \"fin2\", amplitude_deg = 5, seconds = 1}");
  const State before = motion.at(at_s(9.9)), out = motion.at(at_s(11));
  EXPECT_NEAR((out.fins_rad[1] - before.fins_rad[1]) * kDegrees, 5, 0.1);
  EXPECT_NEAR(out.fins_rad[0], before.fins_rad[0], 2e-3);
  EXPECT_NEAR(out.fins_rad[2], before.fins_rad[2], 2e-3);
}

TEST(Mission, FinsAndShaftAsStated) {
  const auto motion = steps("{do = \"direct\", fin1_deg = -25, fin2_deg = 13.75, fin3_deg = 13.75, seconds = 60}");
  const State state = motion.at(at_s(59));
  EXPECT_NEAR(state.fins_rad[0] * kDegrees, -25, 1e-3);
  EXPECT_NEAR(state.rate_rad_s[2] / 0.8070, 1, 0.005) << "as the reference vehicle turns";
  EXPECT_NEAR(motion.at(at_s(0.15)).fins_rad[0] * kDegrees, -25 * (1 - std::exp(-1)), 1) << "the servo's lag";
}

TEST(Mission, BeginsAgainAtItsEndOrGoesOn) {
  const std::string body =
      "start.speed_m_s = 1.1\nstart.depth_m = 1\nstep = [{do = \"leg\", depth_m = 1, seconds = 20},"
      "{do = \"leg\", depth_m = 2, seconds = 20}]\n";
  const auto again = on_mission("mission.at_end = \"repeat\"\n" + body);
  const auto held = on_mission("mission.at_end = \"hold\"\n" + body);
  EXPECT_NEAR(again.duration_s(), held.duration_s(), 1e-9);
  EXPECT_NEAR(again.at(at_s(58)).position_m[2], 1, 0.1);
  EXPECT_NEAR(held.at(at_s(58)).position_m[2], 2, 0.1);
}

TEST(Mission, AStepThatGetsNowhereEnds) {
  const auto motion = steps(
      "{do = \"direct\", shaft_rpm = 0, rudder_deg = 0, elevator_deg = 0, seconds = 60},"
      "{do = \"dive\", depth_m = 50, seconds = 30}, {do = \"turn\", by_deg = 90}");
  EXPECT_LT(motion.duration_s(), 130);
}

class Shipped : public ::testing::TestWithParam<std::string> {};

TEST_P(Shipped, IsSailedUnderWaterToItsEnd) {
  const config::VehicleSettings vehicle;
  const SimulatedMotion motion(vehicle, std::make_unique<MissionHelm>(vehicle, config::load_mission(GetParam())),
                               {});
  const double seconds = motion.duration_s();
  EXPECT_GT(seconds, 30);
  EXPECT_LT(seconds, 900);
  double highest_m = 1, steepest_rad = 0;
  for (double t = 0; t < seconds; t += 0.1) {
    const State state = motion.at(at_s(t));
    highest_m = std::min(highest_m, state.position_m[2]);
    steepest_rad = std::max(steepest_rad, std::abs(state.euler_rad[1]));
  }
  EXPECT_GT(highest_m, -0.02) << "it does not fly";
  EXPECT_LT(steepest_rad * kDegrees, 40);
}

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const auto& mission : config::shipped_missions()) names.emplace_back(mission.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Missions, Shipped, ::testing::ValuesIn(shipped_names()),
                         [](const auto& mission) { return mission.param; });

}  // namespace
}  // namespace navcal::sim::testing
