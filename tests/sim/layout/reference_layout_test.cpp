// SPDX-License-Identifier: Apache-2.0
// The reference vehicle as a layout moves as sim::Vehicle does, in every state and to 1e-9.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "config/layout/layout_file.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/vehicle/drive_helm.h"
#include "tests/sim/vehicle/runs.h"

namespace navcal::sim::testing {
namespace {

ActuatorValues values_of(const Eigen::Vector3d& fins_rad, double shaft_rps) {
  return {{60 * shaft_rps}, {fins_rad[0], fins_rad[1], fins_rad[2]}, {}, {}};
}

/// Greatest difference of any state on the way, both moved by the same helm's actuators as SimulatedMotion does
/// it.
double greatest_difference(const config::VehicleSettings& settings, Helm& helm, double seconds) {
  const Vehicle vehicle(settings);
  const LayoutVehicle layout(layout_of(settings));
  Body a = helm.start(), b = a;
  Actuators now = helm.actuators_at_start();
  double greatest = 0, way_m = 0;
  constexpr double kStep_s = 0.01;
  for (long i = 0; i < std::lround(seconds / kStep_s); ++i) {
    const Actuators next = helm.next(static_cast<double>(i) * kStep_s, kStep_s, a);
    Controls held{next.fins_rad, now.shaft_rps};
    if (!helm.holds_over_steps())
      held = {(now.fins_rad + next.fins_rad) / 2, (now.shaft_rps + next.shaft_rps) / 2};
    a = vehicle.step(a, held, {}, kStep_s).body;
    b = layout.step(b, values_of(held.fins_rad, held.shaft_rps), kStep_s).body;
    now = next;
    way_m += kStep_s * a.velocity.head<3>().norm();
    greatest = std::max({greatest, (a.position_m - b.position_m).cwiseAbs().maxCoeff(),
                         (a.euler_rad - b.euler_rad).cwiseAbs().maxCoeff(),
                         (a.velocity - b.velocity).cwiseAbs().maxCoeff()});
  }
  EXPECT_GT(way_m, 5) << "it has moved";
  return greatest;
}

class ReferenceLayout : public ::testing::TestWithParam<std::string> {};

TEST_P(ReferenceLayout, MovesAsTheVehicleDoesAlongAPath) {
  const auto rows = load_path(std::filesystem::path(NAVCAL_SOURCE_DIR) / "fixtures" / GetParam());
  DriveHelm helm(rows);
  EXPECT_LT(greatest_difference({}, helm, rows.back().t_s - rows.front().t_s), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Fixtures, ReferenceLayout,
                         ::testing::Values("paths/path1.csv", "paths/path2.csv", "paths/path3.csv",
                                           "paths/path4.csv", "paths/path5.csv", "paths/path6.csv",
                                           "paths/path7.csv", "paths/path8.csv", "drive/zigzag.csv"));

class ReferenceLayoutOnAMission : public ::testing::TestWithParam<std::string> {};

TEST_P(ReferenceLayoutOnAMission, MovesAsTheVehicleDoes) {
  const auto file = std::filesystem::path(NAVCAL_SOURCE_DIR) / "config" / "missions" / (GetParam() + ".toml");
  MissionHelm helm({}, config::load_mission(file));
  EXPECT_LT(greatest_difference({}, helm, 200), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Missions, ReferenceLayoutOnAMission,
                         ::testing::Values("thesis1", "thesis4", "thesis6", "survey", "identification"));

TEST(LayoutOfAVehicle, OtherSettingsMoveAlikeToo) {
  config::VehicleSettings settings;
  settings.water.density_kg_m3 = 1025;
  settings.hull.mass_kg = 7;
  settings.hull.length_m = 1.2;
  settings.hull.gravity_below_m = 0.006;
  settings.hull.lift_at_m = -0.1;
  settings.damping.yaw_per_s = 0.4;
  settings.propeller.torque_felt = 0.5;
  MissionHelm helm(settings, config::parse_mission(
                                 "start.shaft_rpm = 780\nstep = [{do = \"leg\", heading_deg = 90, metres = 15}, "
                                 "{do = \"turn\", by_deg = 120}, {do = \"dive\", depth_m = 2}]\n",
                                 "m.toml"));
  EXPECT_LT(greatest_difference(settings, helm, 60), 1e-9);
}

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
