// SPDX-License-Identifier: Apache-2.0
// The shipped layouts are read, can be simulated, and have the published check values of docs/vehicles.md.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <tuple>

#include "config/layout/layout_file.h"
#include "sim/layout/assessment/assessment.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/layout/mass_matrix.h"

namespace navcal::sim::testing {
namespace {

constexpr double kShippedDegrees = 180 / std::numbers::pi;

config::Layout shipped(const std::string& name) {
  return config::load_layout(std::filesystem::path(NAVCAL_SOURCE_DIR) / "share" / "vehicles" / (name + ".toml"));
}

const SteadyMotion& motion_of(const Assessment& found, std::string_view begin) {
  for (const SteadyMotion& motion : found.motions) {
    if (motion.what.starts_with(begin)) return motion;
  }
  throw std::runtime_error("no such motion: " + std::string(begin));
}

TEST(ShippedLayouts, AllAreReadAndCanBeSimulated) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(NAVCAL_SOURCE_DIR "/share/vehicles")) {
    const config::Layout layout = config::load_layout(entry.path());
    EXPECT_FALSE(layout.name.empty()) << entry.path();
    EXPECT_FALSE(layout.sources.empty()) << entry.path();
    EXPECT_EQ(assess(layout).cannot_simulate, "") << entry.path();
    ++count;
  }
  EXPECT_EQ(count, 6);
}

TEST(ShippedLayouts, TheReferenceVehicleIsTheBuiltInOne) {
  config::Layout file = shipped("reference"), built_in = layout_of({});
  file.sources.clear();
  built_in.name = file.name;
  // Sums of floating-point numbers in another order than when the file was written.
  for (std::size_t i = 0; i < file.damping.linear.size(); ++i)
    EXPECT_NEAR(file.damping.linear[i], built_in.damping.linear[i], 1e-12 * std::abs(file.damping.linear[i])) << i;
  built_in.damping.linear = file.damping.linear;
  EXPECT_EQ(file, built_in);
}

TEST(ShippedLayouts, TheReferenceVehicleHasItsCheckValues) {
  const Assessment found = assess(shipped("reference"));
  const LayoutVehicle vehicle(shipped("reference"));
  for (const auto& [rps, speed_m_s] : {std::pair(10.0, 0.872), std::pair(13.0, 1.134), std::pair(16.0, 1.395)}) {
    LayoutRun run(vehicle, {});
    ActuatorValues commands = run.positions();
    commands.thrusters = {60 * rps};
    run.advance(commands, 120);
    EXPECT_NEAR(run.body().velocity[0], speed_m_s, 0.001);
  }
  LayoutRun turn(vehicle, {});
  ActuatorValues commands = turn.positions();
  commands.thrusters = {780};
  commands.surfaces_rad = {-25 / kShippedDegrees, 13.75 / kShippedDegrees, 13.75 / kShippedDegrees};
  turn.advance(commands, 120);
  EXPECT_NEAR(turn.body().velocity[5], 0.8070, 0.0005);
  EXPECT_NEAR(turn.body().velocity[0], 0.948, 0.001);
  EXPECT_NEAR(turn.body().euler_rad[0] * kShippedDegrees, 3.0, 0.1);
  EXPECT_NEAR(turn.body().euler_rad[1] * kShippedDegrees, -12.3, 0.1);
  EXPECT_TRUE(motion_of(found, "straight").is_steady);
  EXPECT_TRUE(motion_of(found, "full rudder").radius_m);
}

TEST(ShippedLayouts, RemusHasThePublishedSpeedAndRoll) {
  // Prestero 2001: 1.54 m/s at 1500 rpm, where a roll of -5.3 degrees balances the propeller's reaction.
  const config::Layout layout = shipped("remus-100");
  const Assessment found = assess(layout);
  ASSERT_FALSE(found.ahead.empty());
  EXPECT_NEAR(found.ahead.back().speed_m_s.value_or(0), 1.54, 0.01);
  const LayoutVehicle vehicle(layout);
  ActuatorValues full = ActuatorValues::neutral(layout);
  full.thrusters = {1500};
  Vector6 velocity = Vector6::Zero();
  velocity[0] = 1.54;
  const LayoutVehicle::Held held = vehicle.hold(full);
  const double reaction_Nm = vehicle.force(velocity, Eigen::Vector3d::UnitZ(), held)[3];
  EXPECT_NEAR(std::asin(reaction_Nm / (layout.weight_N() * 0.0196)) * kShippedDegrees, -5.3, 0.05);
}

TEST(ShippedLayouts, RemusHasThePublishedCoefficients) {
  // Hull, fins and added mass together, over u: Prestero 2001, appendix. The rigid body's own terms are left out.
  const config::Layout layout = shipped("remus-100");
  const LayoutVehicle vehicle(layout);
  LayoutVehicle::Held held = vehicle.hold(ActuatorValues::neutral(layout));
  const Matrix6 rigid = rigid_body_mass(layout, {});
  held.restoring = {0, Eigen::Vector3d::Zero()};
  const double u = 1.5, step = 1e-7;
  const auto coefficient = [&](Eigen::Index force, Eigen::Index by) {
    Vector6 plus = Vector6::Zero(), minus = Vector6::Zero();
    plus[0] = minus[0] = u;
    plus[by] = step;
    minus[by] = -step;
    const auto without_rigid_body = [&](const Vector6& velocity) {
      const Vector6 momentum = rigid * velocity;
      const Eigen::Vector3d v = velocity.head<3>(), omega = velocity.tail<3>();
      Vector6 all = vehicle.force(velocity, Eigen::Vector3d::UnitZ(), held);
      all.head<3>() += omega.cross(momentum.head<3>());
      all.tail<3>() += omega.cross(momentum.tail<3>()) + v.cross(momentum.head<3>());
      return all;
    };
    return (without_rigid_body(plus) - without_rigid_body(minus))[force] / (2 * step * u);
  };
  const std::vector<std::tuple<Eigen::Index, Eigen::Index, double>> published{
      {2, 2, -28.6}, {4, 2, 24.0},  {2, 4, -5.22}, {4, 4, -2.0},
      {1, 1, -28.6}, {5, 1, -24.0}, {1, 5, 5.22},  {5, 5, -2.0}};
  for (const auto& [force, by, value] : published)
    EXPECT_NEAR(coefficient(force, by), value, 0.01 * std::abs(value)) << force << " by " << by;
}

TEST(ShippedLayouts, TheGliderGlidesAsPublished) {
  // Graver 2005, Leonard and Graver 2001: 25 degrees down at 0.30 m/s with 0.047 kg and the mass 0.0198 m forward.
  const LayoutVehicle vehicle(shipped("slocum"));
  Body start;
  start.velocity[0] = 0.3;
  LayoutRun run(vehicle, start);
  ActuatorValues commands = run.positions();
  commands.ballasts_N = {-0.0473 * 9.81};
  commands.masses_m = {0.0198};
  run.advance(commands, 600);
  const Vector6& nu = run.body().velocity;
  const double attack_rad = std::atan2(nu[2], nu[0]);
  EXPECT_NEAR(nu.head<3>().norm(), 0.30, 0.003);
  EXPECT_NEAR((run.body().euler_rad[1] - attack_rad) * kShippedDegrees, -25, 0.5);
  EXPECT_NEAR(attack_rad * kShippedDegrees, 2.02, 0.1);
}

TEST(ShippedLayouts, TheVectoredRovsCommandWhatTheyShould) {
  const Assessment eight = assess(shipped("bluerov2-heavy")), six = assess(shipped("bluerov2"));
  EXPECT_EQ(eight.at_rest.rank, 6);
  EXPECT_EQ(six.at_rest.rank, 5);
  EXPECT_EQ(six.at_rest.commands[4], autopilot::Command::with_others) << "pitch only with surge";
  for (const Assessment* found : {&eight, &six}) {
    EXPECT_GT(found->statics.metacentric_height_m, 0);
    EXPECT_NEAR(motion_of(*found, "turn on the spot").surge_m_s, 0, 0.05);
  }
}

TEST(ShippedLayouts, TheMicroAuvTurnsInRollPitchAndYaw) {
  const Assessment found = assess(shipped("micro-auv"));
  EXPECT_EQ(found.at_rest.rank, 4);
  for (const std::size_t i : {0UL, 3UL, 4UL, 5UL})
    EXPECT_EQ(found.at_rest.commands[i], autopilot::Command::alone) << i;
}

}  // namespace
}  // namespace navcal::sim::testing
