// SPDX-License-Identifier: Apache-2.0
// What a pilot reads of navcald's STATE, what it works out before a mission, and what it shows.
#include <gtest/gtest.h>

#include "base/failure.h"
#include "cli/live/pilot_link.h"
#include "cli/live/pilot_plan.h"
#include "cli/live/pilot_progress.h"
#include "config/mission_file.h"

namespace navcal::cli {
namespace {

constexpr std::string_view kState =
    R"({"class":"STATE","time":1700000000.125,"time_std":0.003,"north":"true","heading_rad":1.57,"pitch_rad":0.01,)"
    R"("roll_rad":-0.02,"rate_rad_s":[0.001,0.002,-0.03],"depth_m":3.2,"lat":59.3,"lon":18.0,"position_std_m":1.9,)"
    R"("speed_m_s":1.1,"climb_m_s":-0.01,"shaft_rpm":780,"fins_deg":[0,-5,5],"std":{"heading_rad":0.02},)"
    R"("age_s":{"compass":0.04,"imu":0.02,"gps":12.5,"motor":0.07},"alarms":["leak forward"],)"
    R"("motor":{"holder":null,"priority":null,"expires_in_s":null},"order":{"sequence":3,"late_s":0.004}})";

TEST(PilotState, TakesWhatAPilotNeeds) {
  const auto state = parse_state(kState);
  ASSERT_TRUE(state);
  EXPECT_DOUBLE_EQ(state->time_s, 1700000000.125);
  EXPECT_FALSE(state->magnetic);
  const autopilot::Reading& reading = state->reading;
  EXPECT_EQ(reading.heading_rad, 1.57);
  EXPECT_EQ(reading.pitch_rad, 0.01);
  EXPECT_EQ(reading.roll_rad, -0.02);
  ASSERT_TRUE(reading.rate_rad_s);
  EXPECT_EQ((*reading.rate_rad_s)[2], -0.03);
  EXPECT_EQ(reading.depth_m, 3.2);
  EXPECT_NEAR(*reading.latitude_rad, 1.034980, 1e-6);
  EXPECT_EQ(reading.speed_m_s, 1.1);
  EXPECT_EQ(reading.compass_age_s, 0.04);
  EXPECT_EQ(reading.motor_age_s, 0.07);
  EXPECT_EQ(reading.alarms, std::vector<std::string>{"leak forward"});
}

TEST(PilotState, NullsAreUnknown) {
  const auto state = parse_state(
      R"({"class":"STATE","time":1,"north":"magnetic","heading_rad":null,"rate_rad_s":[0,null,0],"depth_m":"3",)"
      R"("age_s":{"compass":null},"alarms":null})");
  ASSERT_TRUE(state);
  EXPECT_TRUE(state->magnetic);
  EXPECT_FALSE(state->reading.heading_rad);
  EXPECT_FALSE(state->reading.rate_rad_s);
  EXPECT_FALSE(state->reading.depth_m);
  EXPECT_FALSE(state->reading.compass_age_s);
  EXPECT_TRUE(state->reading.alarms.empty());
}

TEST(PilotState, OtherLinesAreNone) {
  for (const char* line : {"", "no JSON", "[]", "3", "{}", R"({"class":"TPV","time":1})", R"({"class":"STATE"})"})
    EXPECT_FALSE(parse_state(line)) << line;
}

std::string refusal(const autopilot::PilotLimits& limits, std::string_view toml) {
  try {
    (void)plan_mission({}, config::parse_mission(toml, "test.toml"), limits);
    return {};
  } catch (const base::Failure& failure) {
    return failure.what();
  }
}

TEST(PilotPlan, IsThatOfTheSimulatedVehicle) {
  const auto plan = plan_mission(
      {}, config::parse_mission("start.speed_m_s = 1.134\nstep = [{do = \"leg\", seconds = 60}]\n", "test.toml"),
      {});
  EXPECT_NEAR(plan.duration_s, 60, 0.2);
  EXPECT_NEAR(plan.farthest_m, 60 * 1.134, 0.7);
  EXPECT_LT(plan.deepest_m, 0.3);
}

TEST(PilotPlan, RefusesWhatGoesBeyondALimit) {
  constexpr std::string_view kDive = "step = [{do = \"dive\", depth_m = 3}, {do = \"leg\", seconds = 60}]\n";
  EXPECT_EQ(refusal({}, kDive), "");
  EXPECT_NE(refusal({.depth_m = 2}, kDive).find("--max-depth"), std::string::npos);
  EXPECT_NE(refusal({.duration_s = 30}, kDive).find("--max-minutes"), std::string::npos);
  EXPECT_NE(refusal({.range_m = 30}, kDive).find("--max-range"), std::string::npos);
}

TEST(PilotPlan, AMissionThatNeverEndsIsRefused) {
  EXPECT_NE(refusal({}, "start.shaft_rpm = 0\nstep = [{do = \"leg\", metres = 100}]\n").find("--max-minutes"),
            std::string::npos);
}

TEST(PilotProgress, TellsStepHeadingDepthSpeedAndTimeLeft) {
  const auto mission =
      config::parse_mission("step = [{do = \"dive\", depth_m = 3}, {do = \"leg\", seconds = 60}]\n", "test.toml");
  const autopilot::Pilot pilot({}, mission, {});
  autopilot::Reading reading;
  reading.heading_rad = -0.001;
  reading.depth_m = 1.234;
  EXPECT_EQ(progress_text(pilot, reading, 150.6), "1/2 dive, heading 000, depth 1.23 m, speed ? m/s, 2:31 left");
}

}  // namespace
}  // namespace navcal::cli
