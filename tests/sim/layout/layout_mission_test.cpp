// SPDX-License-Identifier: Apache-2.0
// Layouts on missions: what they can do they do, what they cannot is said by the degree of freedom.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "config/layout/layout_file.h"
#include "config/mission_file.h"
#include "sim/effects/effect_set.h"
#include "sim/layout/control/layout_mission_helm.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/pulses.h"
#include "sim/vehicle/ordered_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::sim::testing {
namespace {

constexpr double kMissionDegrees = 180 / std::numbers::pi;

config::Layout shipped_layout(const std::string& name) {
  return config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/" + name + ".toml");
}

config::Mission mission_of(const std::string& steps, const std::string& start = "start.shaft_rpm = 0\n") {
  return config::parse_mission(
      "mission.at_end = \"hold\"\nstart.depth_m = 0.5\n" + start + "step = [" + steps + "]\n", "mission");
}

std::unique_ptr<SimulatedMotion> steered(const config::Layout& layout, const config::Mission& mission,
                                         VehicleInfluencer* influencer = nullptr) {
  return std::make_unique<SimulatedMotion>(layout, std::make_unique<LayoutMissionHelm>(layout, mission),
                                           MotionOptions{.influencer = influencer});
}

State layout_at(const SimulatedMotion& motion, double time_s) { return motion.at(std::llround(time_s * 1e9)); }

std::string why_unfit(const config::Layout& layout, const config::Mission& mission) {
  try {
    const LayoutMissionHelm helm(layout, mission);
  } catch (const UnfitLayout& error) {
    return error.what();
  }
  return {};
}

TEST(LayoutMission, AnRovGoesStraightTurnsAndHovers) {
  const config::Layout layout = shipped_layout("bluerov2-heavy");
  const auto motion =
      steered(layout, mission_of("{do = \"dive\", depth_m = 2}, {do = \"leg\", seconds = 30, speed_m_s = "
                                 "0.4}, {do = \"turn\", by_deg = 90, rate_deg_s = 15}, {do = "
                                 "\"leg\", seconds = 20, shaft_rpm = 0}"));
  const double duration_s = motion->duration_s();
  State state = layout_at(*motion, duration_s);
  EXPECT_NEAR(state.position_m[2], 2, 0.05);
  EXPECT_NEAR(state.euler_rad[2] * kMissionDegrees, 90, 1);
  EXPECT_NEAR(state.velocity_body_m_s[0], 0, 0.02);
  EXPECT_GT(state.position_m[0], 10) << "the leg";
  for (double t = 0; t < duration_s; t += 0.5) {
    state = layout_at(*motion, t);
    EXPECT_LT(std::abs(state.euler_rad[0]) * kMissionDegrees, 5) << t;
    EXPECT_LT(std::abs(state.euler_rad[1]) * kMissionDegrees, 5) << t;
  }
}

TEST(LayoutMission, EveryShippedLayoutThatCanDoesTheSurveyAtItsDepth) {
  for (const char* name : {"reference", "bluerov2-heavy", "micro-auv"}) {
    const auto motion = steered(shipped_layout(name), config::load_mission("survey"));
    const State state = layout_at(*motion, 80);
    EXPECT_NEAR(state.position_m[2], 1.5, 0.1) << name;
    EXPECT_NEAR(state.euler_rad[2], 0, 0.02) << name;
    EXPECT_GT(state.velocity_body_m_s[0], 0.3) << name;
  }
}

TEST(LayoutMission, RemusHoldsItsDepthWhenItIsNearlyNeutral) {
  config::Layout layout = shipped_layout("remus-100");
  EXPECT_NE(why_unfit(layout, config::load_mission("survey")).find("+8.99 N of net buoyancy"), std::string::npos)
      << why_unfit(layout, config::load_mission("survey"));
  layout.body.buoyancy_N = layout.weight_N() + 1;
  const auto motion = steered(layout, config::load_mission("survey"));
  const State state = layout_at(*motion, 80);
  EXPECT_NEAR(state.position_m[2], 1.5, 0.15);
  EXPECT_NEAR(state.velocity_body_m_s[0], 1.13, 0.05);
}

TEST(LayoutMission, AGliderGlidesDownAndUp) {
  const auto motion = steered(shipped_layout("slocum"),
                              mission_of("{do = \"dive\", depth_m = 15, seconds = 300}, {do = \"dive\", depth_m = "
                                         "3, seconds = 300}"));
  EXPECT_LT(motion->duration_s(), 500);
  EXPECT_GT(layout_at(*motion, 60).velocity_body_m_s[0], 0.2);
  EXPECT_LT(layout_at(*motion, 30).euler_rad[1] * kMissionDegrees, -15);
  EXPECT_NEAR(layout_at(*motion, motion->duration_s()).position_m[2], 3, 0.2);
}

TEST(LayoutMission, WhatIsMissingIsNamed) {
  const config::Layout glider = shipped_layout("slocum");
  EXPECT_NE(why_unfit(glider, mission_of("{do = \"leg\", seconds = 5, speed_m_s = 0.3}"))
                .find("surge cannot be commanded, which step[1] (leg) of the mission needs"),
            std::string::npos);
  EXPECT_NE(why_unfit(glider, mission_of("{do = \"dive\", depth_m = 2}, {do = \"turn\", by_deg = 90}"))
                .find("yaw cannot be commanded, which step[2] (turn) of the mission needs"),
            std::string::npos);
  config::Layout rov = shipped_layout("bluerov2");
  EXPECT_NE(why_unfit(rov, mission_of("{do = \"doublet\", on = \"elevator\", amplitude_deg = 5, seconds = 1}"))
                .find("pitch cannot be commanded, which step[1] (doublet)"),
            std::string::npos);
  EXPECT_NE(
      why_unfit(rov, mission_of("{do = \"direct\", fin2_deg = 5, seconds = 1}")).find("there is no surface 2"),
      std::string::npos);
  rov.thrusters.resize(4);
  EXPECT_NE(why_unfit(rov, mission_of("{do = \"leg\", seconds = 5}")).find("heave cannot be commanded"),
            std::string::npos);
  rov = shipped_layout("bluerov2");
  rov.body.buoyancy_centre_m[2] = 0.01;
  EXPECT_NE(why_unfit(rov, mission_of("{do = \"leg\", seconds = 5}")).find("no speed ahead is borne"),
            std::string::npos);
}

TEST(LayoutMission, ALegThatIsNeverDoneEndsInWords) {
  const config::Layout layout = shipped_layout("bluerov2-heavy");
  const auto motion = steered(layout, mission_of("{do = \"leg\", metres = 50}"));
  try {
    (void)motion->duration_s();
    FAIL() << "it ended";
  } catch (const UnfitLayout& error) {
    EXPECT_NE(std::string(error.what()).find("step[1] (leg) of the mission does not end"), std::string::npos)
        << error.what();
  }
}

TEST(LayoutMission, WhereALayoutIsTooSlowItIsSaid) {
  const LayoutMissionHelm slow(shipped_layout("bluerov2"), config::load_mission("survey"));
  EXPECT_NE(slow.remark().find("speeds are held at"), std::string::npos);
  const LayoutMissionHelm able(shipped_layout("reference"), config::load_mission("survey"));
  EXPECT_EQ(able.remark(), "");
}

TEST(LayoutMission, AnEffectActsInItsIntervalOnly) {
  const config::Layout layout = shipped_layout("bluerov2-heavy");
  const config::Mission mission = mission_of("{do = \"leg\", seconds = 40, speed_m_s = 0.4, depth_m = 2}");
  EffectSet effects;
  effects.add({find_layout_effect("actuator_dead"), "thruster.5", {1}}, {15, 20});
  const auto nominal = steered(layout, mission), broken = steered(layout, mission, &effects);
  EXPECT_EQ(layout_at(*nominal, 15).position_m, layout_at(*broken, 15).position_m);
  EXPECT_GT(std::abs(layout_at(*nominal, 18).euler_rad[0] - layout_at(*broken, 18).euler_rad[0]) +
                std::abs(layout_at(*nominal, 18).euler_rad[1] - layout_at(*broken, 18).euler_rad[1]),
            0.01);
  EXPECT_NEAR(layout_at(*nominal, 40).euler_rad[1], layout_at(*broken, 40).euler_rad[1], 0.05) << "it recovers";
}

TEST(LayoutMission, OutputsAreToldTenTimesASecondAndAreTheCommands) {
  const config::Layout layout = shipped_layout("bluerov2-heavy");
  const auto motion = steered(layout, mission_of("{do = \"leg\", seconds = 10, speed_m_s = 0.4}"));
  std::vector<OutputOrder> outputs;
  motion->take_outputs(5'000'000'000, outputs);
  ASSERT_EQ(outputs.size(), 51U);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    EXPECT_EQ(outputs[i].time_ns, static_cast<std::int64_t>(i) * 100'000'000);
    ASSERT_EQ(outputs[i].pulses_us.size(), 8U);
    for (const double pulse : outputs[i].pulses_us) EXPECT_EQ(pulse, std::round(pulse));
  }
}

TEST(LayoutMission, TheHullFloats) {
  config::Layout layout = shipped_layout("bluerov2-heavy");
  layout.body.buoyancy_N = layout.weight_N() + 5;
  const SimulatedMotion motion(layout, std::make_unique<OrderedHelm>(layout), {});
  const double depth_m = layout_at(motion, 60).position_m[2];
  // 5 N of 137 N are above the water: the origin lies deeper than half the height by the share that is in it.
  EXPECT_NEAR(depth_m, (0.5 - 5 / layout.body.buoyancy_N) * layout.body.size_m[2], 0.005);
}

TEST(LayoutMission, OrdersMoveTheActuatorsThatTheyName) {
  const config::Layout layout = layout_of({});
  auto helm = std::make_unique<OrderedHelm>(layout);
  helm->order(1, {1700, std::nullopt, 1600});
  const SimulatedMotion motion(layout, std::move(helm), {});
  (void)layout_at(motion, 10);
  EXPECT_NEAR(motion.positions().thrusters[0], 0.5 * layout.thrusters[0].high, 1e-3);
  EXPECT_EQ(motion.positions().surfaces_rad[0], 0);
  EXPECT_NEAR(motion.positions().surfaces_rad[1], 0.25 * layout.surfaces[1].limit_rad, 1e-9);
}

TEST(Pulses, AreWholeAndGiveTheCommandsBack) {
  for (const char* name : {"reference", "remus-100", "bluerov2", "micro-auv", "slocum"}) {
    const config::Layout layout = shipped_layout(name);
    std::vector<double> pulses;
    for (std::size_t i = 0; i < outputs_of(layout); ++i)
      pulses.push_back(1500 + 37.0 * static_cast<double>(i + 1));
    const ActuatorValues commands = commands_of(layout, pulses);
    EXPECT_EQ(pulses_of(layout, commands), pulses) << name;
    const ActuatorValues neutral = ActuatorValues::neutral(layout);
    for (const double pulse : pulses_of(layout, neutral)) EXPECT_EQ(pulse, 1500) << name;
  }
  const config::Layout remus = shipped_layout("remus-100");
  EXPECT_EQ(commands_of(remus, {1100}).thrusters[0], 0) << "it does not turn backwards";
  EXPECT_EQ(commands_of(remus, {1900}).thrusters[0], 1500);
}

}  // namespace
}  // namespace navcal::sim::testing
