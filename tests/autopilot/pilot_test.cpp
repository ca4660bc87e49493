// SPDX-License-Identifier: Apache-2.0
// What a pilot decides, by readings made up: no sockets, no clock.
#include "autopilot/pilot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/angles.h"
#include "config/mission_file.h"

namespace navcal::autopilot::testing {
namespace {

constexpr double kPeriod_s = 0.1;

/// Under way at 1 m/s, one metre deep, north, all instruments fresh.
Reading good() {
  Reading reading;
  reading.heading_rad = 0;
  reading.pitch_rad = reading.roll_rad = 0;
  reading.rate_rad_s = Eigen::Vector3d::Zero();
  reading.depth_m = 1;
  reading.speed_m_s = 1;
  reading.compass_age_s = reading.imu_age_s = reading.motor_age_s = 0.05;
  return reading;
}

struct PilotDecisions : ::testing::Test {
  config::VehicleSettings vehicle;
  PilotLimits limits;
  Pilot pilot = on("start.depth_m = 1\nstep = [{do = \"leg\", heading_deg = 0, seconds = 20}]\n");
  double now_s = 1000;

  [[nodiscard]] Pilot on(std::string_view toml) const {
    return {vehicle, config::parse_mission(toml, "test.toml"), limits};
  }
  Orders give(const Reading& reading) {
    now_s += kPeriod_s;
    return pilot.next(reading, now_s);
  }
  void sail(double seconds) {
    for (double t_s = 0; t_s < seconds - 1e-6; t_s += kPeriod_s) give(good());
  }
  /// The reading that `change` makes of a good one stops the vehicle, for a reason with `word` in it.
  void expect_stop(const std::function<void(Reading&)>& change, std::string_view word) {
    sail(2);
    ASSERT_FALSE(pilot.stopping());
    Reading reading = good();
    change(reading);
    const Orders orders = give(reading);
    ASSERT_TRUE(pilot.stopping());
    ASSERT_TRUE(pilot.reason());
    EXPECT_NE(pilot.reason()->find(word), std::string::npos) << *pilot.reason();
    EXPECT_EQ(orders.shaft_rps, 0);
  }
};

TEST_F(PilotDecisions, SailsAMissionOnceAndStopsTheVehicleAtItsEnd) {
  sail(19);
  EXPECT_FALSE(pilot.stopping());
  EXPECT_GT(pilot.mission().last().shaft_rps, 10);
  sail(2);
  EXPECT_TRUE(pilot.stopping());
  EXPECT_FALSE(pilot.reason()) << "the mission is done, nothing went wrong";
}

TEST_F(PilotDecisions, TurnsTheShorterWayToTheFirstHeading) {
  pilot = on("start.heading_deg = 350\nstart.depth_m = 1\nstep = [{do = \"leg\", seconds = 20}]\n");
  Reading reading = good();
  reading.heading_rad = 10 * base::kRadiansPerDegree;
  EXPECT_LT(give(reading).rudder_rad, 0) << "to port, from 10 to 350 degrees";
}

TEST_F(PilotDecisions, FollowsAHeadingThroughNorth) {
  for (int i = 0; i < 20; ++i) {
    Reading reading = good();
    reading.heading_rad = (i % 2 == 0 ? 358 : 2) * base::kRadiansPerDegree;
    EXPECT_NEAR(give(reading).rudder_rad, (i % 2 == 0 ? 1.2 : -1.2) * 2 * base::kRadiansPerDegree, 1e-9);
  }
}

TEST_F(PilotDecisions, StopsOnALeak) {
  expect_stop([](Reading& reading) { reading.alarms = {"over range", "leak aft"}; }, "leak aft");
}
TEST_F(PilotDecisions, StopsOnLowSupply) {
  expect_stop([](Reading& reading) { reading.alarms = {"low supply"}; }, "low supply");
}
TEST_F(PilotDecisions, StopsOnALowBattery) {
  expect_stop([](Reading& reading) { reading.alarms = {"battery low"}; }, "battery low");
}
TEST_F(PilotDecisions, StopsNearTheFloor) {
  expect_stop([](Reading& reading) { reading.alarms = {"floor near"}; }, "floor near");
}
TEST_F(PilotDecisions, StopsBelowTheLeastAltitude) {
  limits.altitude_m = 2;
  pilot = on("start.depth_m = 1\nstep = [{do = \"leg\", seconds = 20}]\n");
  expect_stop([](Reading& reading) { reading.altitude_m = 1.9; }, "1.90 m above the floor, less than 2 m");
}
TEST_F(PilotDecisions, StopsWhenTheCompassGoesSilent) {
  expect_stop([](Reading& reading) { reading.compass_age_s = 1.2; }, "compass: silent for 1.2 s");
}
TEST_F(PilotDecisions, StopsWhenTheInertialCardGoesSilent) {
  expect_stop([](Reading& reading) { reading.imu_age_s = 1.2; }, "inertial card: silent");
}
TEST_F(PilotDecisions, StopsWhenTheMotorCardGoesSilent) {
  expect_stop([](Reading& reading) { reading.motor_age_s.reset(); }, "motor card: silent");
}
TEST_F(PilotDecisions, StopsWithoutADepth) {
  expect_stop([](Reading& reading) { reading.depth_m.reset(); }, "no depth");
}
TEST_F(PilotDecisions, StopsBelowTheGreatestDepth) {
  expect_stop([](Reading& reading) { reading.depth_m = 10.1; }, "depth 10.10 m, more than 10 m");
}
TEST_F(PilotDecisions, StopsOutsideItsAreaByPosition) {
  Reading first = good();
  first.latitude_rad = 0.6;
  first.longitude_rad = -1.4;
  give(first);
  expect_stop(
      [&](Reading& reading) {
        reading.latitude_rad = 0.6 + 1100 / 6.37e6;
        reading.longitude_rad = -1.4;
      },
      "more than 1000 m");
}

TEST_F(PilotDecisions, StopsOutsideItsAreaByReckoningWithoutAnyPosition) {
  limits.range_m = 15;
  pilot = on("start.depth_m = 1\nstep = [{do = \"leg\", seconds = 20}]\n");
  sail(14);
  EXPECT_FALSE(pilot.stopping());
  sail(2);
  EXPECT_TRUE(pilot.stopping());
}

TEST_F(PilotDecisions, WithoutASpeedTheShaftTellsTheWay) {
  limits.range_m = 10;
  pilot = on("start.depth_m = 1\nstep = [{do = \"leg\", seconds = 20}]\n");
  Reading reading = good();
  reading.speed_m_s.reset();
  for (int i = 0; i < 100; ++i) give(reading);
  EXPECT_TRUE(pilot.stopping()) << "780 rpm for 10 s are 11 m";
}

TEST_F(PilotDecisions, StopsAfterTheLongestTime) {
  limits.duration_s = 10;
  pilot = on("start.depth_m = 1\nstep = [{do = \"leg\", seconds = 20}]\n");
  sail(9.9);
  EXPECT_FALSE(pilot.stopping());
  sail(0.5);
  EXPECT_TRUE(pilot.stopping());
}

TEST_F(PilotDecisions, AStopSteersToTheSurfaceThenLetsTheFinsGoNeutral) {
  sail(2);
  pilot.stop("interrupted", now_s);
  const Orders orders = give(good());
  EXPECT_EQ(orders.shaft_rps, 0);
  EXPECT_GT(orders.elevator_rad, 0.05);
  EXPECT_GT(orders.fins_rad[1], 0.05) << "nose up: fin 2 positive, fin 3 negative";
  EXPECT_LT(orders.fins_rad[2], -0.05);
  for (const double fin_rad : orders.fins_rad) EXPECT_LE(std::abs(fin_rad), 25 * base::kRadiansPerDegree);
  EXPECT_FALSE(pilot.stopped(now_s));
  sail(Pilot::kRise_s + 0.2);
  EXPECT_TRUE(pilot.stopped(now_s));
  const Orders last = give(good());
  EXPECT_EQ(last.shaft_rps, 0);
  EXPECT_EQ(last.fins_rad, Eigen::Vector3d::Zero());
}

TEST_F(PilotDecisions, AtTheSurfaceAStopLeavesTheFinsNeutral) {
  sail(2);
  pilot.stop("interrupted", now_s);
  Reading reading = good();
  reading.depth_m = 0.15;
  EXPECT_EQ(give(reading).fins_rad, Eigen::Vector3d::Zero());
  for (int i = 0; i < 12; ++i) give(reading);
  EXPECT_TRUE(pilot.stopped(now_s));
}

TEST_F(PilotDecisions, AStopByASilentCompassLeavesTheFinsNeutral) {
  sail(2);
  Reading reading = good();
  reading.compass_age_s = 3;
  EXPECT_EQ(give(reading).fins_rad, Eigen::Vector3d::Zero()) << "there is nothing to steer by";
}

TEST_F(PilotDecisions, TheFirstReasonStaysAndAStopIsForGood) {
  expect_stop([](Reading& reading) { reading.alarms = {"leak forward"}; }, "leak");
  pilot.stop("interrupted", now_s);
  EXPECT_EQ(give(good()).shaft_rps, 0) << "the alarm is over, the vehicle stays stopped";
  EXPECT_EQ(*pilot.reason(), "leak forward");
}

TEST_F(PilotDecisions, ALateReadingMakesNoIntegralLeap) {
  Reading low = good();
  low.depth_m = 1.2;
  for (int i = 0; i < 10; ++i) give(low);
  const double before_rad = give(low).elevator_rad;
  now_s += 30;
  EXPECT_NEAR(give(low).elevator_rad, before_rad, 0.03);
}

TEST_F(PilotDecisions, SaysAllThatIsMissing) {
  EXPECT_TRUE(pilot.missing(good()).empty());
  Reading reading = good();
  reading.compass_age_s.reset();
  reading.heading_rad.reset();
  reading.motor_age_s = 5;
  const auto missing = pilot.missing(reading);
  ASSERT_EQ(missing.size(), 3U);
  EXPECT_NE(missing[0].find("compass"), std::string::npos);
  EXPECT_NE(missing[1].find("motor card"), std::string::npos);
  EXPECT_EQ(missing[2], "no heading");
}

TEST_F(PilotDecisions, DoesNotBeginWithALeak) {
  Reading reading = good();
  reading.alarms = {"leak forward"};
  EXPECT_EQ(pilot.missing(reading), std::vector<std::string>{"leak forward"});
}

}  // namespace
}  // namespace navcal::autopilot::testing
