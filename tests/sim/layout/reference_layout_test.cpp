// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "config/layout/layout_file.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::sim::testing {
namespace {

TEST(LayoutOfAVehicle, ItsFileGivesItBackToTheLastBit) {
  const config::Layout layout = layout_of({});
  EXPECT_EQ(config::parse_layout(config::layout_file(layout), "l.toml"), layout);
}

TEST(LayoutOfAVehicle, FollowsCommandsAsTheHelmDoes) {
  // Exactly over a step: after one lag 1 - 1/e of the way, whatever the step.
  const config::Layout layout = layout_of({});
  ActuatorValues positions = ActuatorValues::neutral(layout);
  ActuatorValues commands = positions;
  commands.thrusters = {780};
  commands.surfaces_rad = {0.2, -0.1, 9};
  for (int i = 0; i < 50; ++i) positions = follow(layout, positions, commands, 0.01);
  EXPECT_NEAR(positions.thrusters[0], 780 * (1 - std::exp(-1)), 1e-9);
  EXPECT_NEAR(positions.surfaces_rad[0], 0.2 * (1 - std::exp(-0.5 / 0.15)), 1e-12);
  EXPECT_DOUBLE_EQ(positions.surfaces_rad[2], layout.surfaces[2].limit_rad);
}

TEST(LayoutOfAVehicle, SettlesAtThePublishedSpeed) {
  const LayoutVehicle vehicle(layout_of({}));
  LayoutRun run(vehicle, {});
  ActuatorValues commands = run.positions();
  commands.thrusters = {780};
  run.advance(commands, 120);
  EXPECT_NEAR(run.body().velocity[0], 1.134, 0.001);
}

}  // namespace
}  // namespace navcal::sim::testing
