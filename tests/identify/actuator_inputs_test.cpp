// SPDX-License-Identifier: Apache-2.0
#include "identify/data/actuator_inputs.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/layout/layout_file.h"
#include "sim/layout/actuators.h"
#include "sim/layout/pulses.h"

namespace navcal::identify {
namespace {

/// Commands of the shipped micro AUV, whose thrusters are in percent, as `value` of each of its outputs.
RecordedMotion commanded(double first, double second, bool as_pulses) {
  RecordedMotion motion;
  motion.duration_s = 4;
  for (int output = 1; output <= 4; ++output) {
    Signal& signal = motion.signals["output" + std::to_string(output)];
    signal.times_s = {0, 2};
    signal.values = {first, second};
    signal.is_pulse = as_pulses;
  }
  return motion;
}

TEST(ActuatorInputs, TakesPulsesForThrustersInPercent) {
  const config::Layout layout = config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml");
  ASSERT_EQ(layout.thrusters.front().unit, config::CommandUnit::percent);
  const RecordedMotion in_percent = commanded(50, -25, false), in_pulses = commanded(1700, 1400, true);
  const ActuatorInputs percent(layout, in_percent), pulses(layout, in_pulses);
  EXPECT_TRUE(pulses.missing().empty());
  EXPECT_EQ(pulses.oddities(layout), percent.oddities(layout));
  const ActuatorTrajectory wanted = percent.trajectory(layout), found = pulses.trajectory(layout);
  for (const double time_s : {0.5, 1.9, 2.2, 3.8}) {
    sim::ActuatorValues one = sim::ActuatorValues::neutral(layout), other = one;
    wanted.at(time_s, one);
    found.at(time_s, other);
    for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
      EXPECT_NEAR(other.thrusters[i], one.thrusters[i], 1e-9) << time_s;
      EXPECT_NE(one.thrusters[i], 0) << time_s;
    }
  }
}

// The commands of a glider's own log, as they are imported.
TEST(ActuatorInputs, TheShippedGliderFollowsBallastAndMovingMass) {
  const config::Layout layout = config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/slocum.toml");
  RecordedMotion motion;
  motion.duration_s = 60;
  const RecordedMotion silent = motion;
  motion.signals["ballast"] = {{0, 1}, {1.5, 1.5}};
  motion.signals["moving_mass"] = {{0, 1}, {-0.02, -0.02}};
  const ActuatorInputs inputs(layout, motion), none(layout, silent);
  EXPECT_TRUE(inputs.missing().empty());
  EXPECT_TRUE(none.missing().empty()) << "neutral";
  sim::ActuatorValues found = sim::ActuatorValues::neutral(layout), still = found;
  inputs.trajectory(layout).at(59, found);
  none.trajectory(layout).at(59, still);
  EXPECT_NEAR(found.ballasts_N.at(0), 1.5, 1e-9);
  EXPECT_NEAR(found.masses_m.at(0), -0.02, 1e-9);
  EXPECT_EQ(still.ballasts_N.at(0), 0);
}

// A layout with a propeller in rpm and fins could not be diagnosed on what navcal simulate records of it.
TEST(ActuatorInputs, OutputsOfAllActuatorsAreTheirCommandsInTheOrderOfTheLayout) {
  const config::Layout layout = config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/remus-100.toml");
  sim::ActuatorValues commands = sim::ActuatorValues::neutral(layout);
  commands.thrusters[0] = 900;
  for (std::size_t i = 0; i < commands.surfaces_rad.size(); ++i)
    commands.surfaces_rad[i] = layout.surfaces[i].limit_rad * (i % 2 == 0 ? 0.5 : -0.25);
  const std::vector<double> pulses = sim::pulses_of(layout, commands);
  RecordedMotion motion;
  motion.duration_s = 10;
  for (std::size_t i = 0; i < pulses.size(); ++i)
    motion.signals["output" + std::to_string(i + 1)] = {{0, 1}, {pulses[i], pulses[i]}, true};
  const ActuatorInputs inputs(layout, motion);
  EXPECT_TRUE(inputs.missing().empty());
  EXPECT_TRUE(inputs.follow_commands());
  ASSERT_EQ(inputs.oddities(layout).size(), 1U);
  EXPECT_NE(inputs.oddities(layout)[0].find("in its order"), std::string::npos);
  sim::ActuatorValues found = sim::ActuatorValues::neutral(layout);
  inputs.trajectory(layout).at(9, found);
  EXPECT_NEAR(found.thrusters[0], 900, 2);
  for (std::size_t i = 0; i < commands.surfaces_rad.size(); ++i)
    EXPECT_NEAR(found.surfaces_rad[i], commands.surfaces_rad[i], 0.002) << i;

  // An output more, and which one moves what is not known.
  motion.signals["output" + std::to_string(pulses.size() + 1)] = {{0, 1}, {1500, 1500}, true};
  EXPECT_FALSE(ActuatorInputs(layout, motion).missing().empty());
}

}  // namespace
}  // namespace navcal::identify
