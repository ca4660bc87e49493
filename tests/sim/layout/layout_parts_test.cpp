// SPDX-License-Identifier: Apache-2.0
// Properties of the parts of the model of a layout.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <random>

#include "autopilot/thrust_curve.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/layout/mass_matrix.h"

namespace navcal::sim::testing {
namespace {

config::Layout brick() {
  config::Layout layout;
  layout.body.mass_kg = 10;
  layout.body.gravity_centre_m = {0.03, -0.02, 0.05};
  layout.body.inertia_kg_m2 = {0.3, 0.5, 0.6, 0.01, -0.02, 0.03};
  layout.body.buoyancy_N = layout.weight_N();
  return layout;
}

config::LayoutThruster propeller() {
  config::LayoutThruster thruster;
  thruster.diameter_m = 0.1;
  thruster.KT = {0.4, -0.3};
  thruster.KQ = {0.03};
  thruster.reverse_efficiency = 0.6;
  thruster.low = -1500;
  thruster.high = 1500;
  return thruster;
}

config::LayoutThruster esc() {
  config::LayoutThruster thruster;
  thruster.unit = config::CommandUnit::microseconds;
  thruster.table_command = {1100, 1470, 1530, 1900};
  thruster.table_force_N = {-40, 0, 0, 50};
  thruster.advance_loss_sqrtN_s_m = 1.5;
  thruster.low = 1100;
  thruster.high = 1900;
  thruster.dead_band = 30;
  return thruster;
}

TEST(RigidBody, HasTheKineticEnergyOfItsPoints) {
  // Four point masses: 1/2 nu' M nu is the sum of 1/2 m |v + omega x r|^2.
  const std::vector<std::pair<double, Eigen::Vector3d>> points{
      {2, {0.3, 0, 0.1}}, {3, {-0.2, 0.1, 0}}, {1, {0, -0.3, 0.2}}, {4, {0.1, 0.1, -0.2}}};
  config::Layout layout;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& [m, r] : points) {
    layout.body.mass_kg += m;
    centre += m * r;
  }
  centre /= layout.body.mass_kg;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const auto& [m, r] : points) inertia -= m * skew(r - centre) * skew(r - centre);
  layout.body.gravity_centre_m = {centre.x(), centre.y(), centre.z()};
  layout.body.inertia_kg_m2 = {inertia(0, 0), inertia(1, 1), inertia(2, 2),
                               inertia(0, 1), inertia(0, 2), inertia(1, 2)};
  // The last point moves along y: as a moving mass and as another body.
  layout.moving_masses = {{"m", 4, {0.1, 0.1, -0.2}, {0, 2, 0}, -1, 1, 0.1}};
  Vector6 nu;
  nu << 0.7, -0.4, 0.2, 1.1, -0.6, 0.9;
  for (const double way_m : {0.0, 0.25, -0.5}) {
    double energy = 0;
    for (const auto& [m, r] : points) {
      const Eigen::Vector3d at = m == 4 ? Eigen::Vector3d(r + Eigen::Vector3d(0, way_m, 0)) : r;
      energy += 0.5 * m * (nu.head<3>() + nu.tail<3>().cross(at)).squaredNorm();
    }
    EXPECT_NEAR(0.5 * nu.dot(rigid_body_mass(layout, {way_m}) * nu), energy, 1e-12);
  }
}

TEST(LayoutVehicle, WithoutDampingAndGravityEnergyIsConstant) {
  config::Layout layout = brick();
  layout.added_mass.matrix_kg[0] = 2;
  layout.added_mass.matrix_kg[7] = 9;
  layout.added_mass.matrix_kg[14] = 12;
  layout.body.buoyancy_centre_m = layout.body.gravity_centre_m;
  const LayoutVehicle vehicle(layout);
  const Matrix6 mass = rigid_body_mass(layout, {}) + added_mass(layout);
  Body body;
  body.velocity << 0.5, 0.2, -0.1, 0.3, -0.2, 0.4;
  const double before = body.velocity.dot(mass * body.velocity);
  for (int i = 0; i < 200; ++i) body = vehicle.step(body, {}, 0.01).body;
  EXPECT_NEAR(body.velocity.dot(mass * body.velocity) / before, 1, 1e-8);
}

TEST(LayoutVehicle, RestsWhereItsWeightHangsBelowItsBuoyancy) {
  config::Layout layout = brick();
  for (std::size_t i = 0; i < 6; ++i) layout.damping.linear[7 * i] = i < 3 ? 20 : 2;
  const LayoutVehicle vehicle(layout);
  LayoutRun run(vehicle, {});
  run.advance(run.positions(), 60);
  EXPECT_NEAR(run.body().euler_rad[0], std::atan2(-0.02, 0.05), 1e-6);
  EXPECT_NEAR(run.body().euler_rad[1], -std::atan2(0.03, std::hypot(0.02, 0.05)), 1e-6);
  EXPECT_NEAR(run.body().velocity.norm(), 0, 1e-6);
}

TEST(LayoutVehicle, BallastLiftsAndAMovingMassPitches) {
  config::Layout layout = brick();
  for (std::size_t i = 0; i < 6; ++i) layout.damping.linear[7 * i] = i < 3 ? 20 : 2;
  layout.ballasts = {{"tank", {}, -2, 2, 1}};
  layout.moving_masses = {{"battery", 2, {}, {1, 0, 0}, -0.1, 0.1, 0.05}};
  const LayoutVehicle vehicle(layout);
  LayoutRun run(vehicle, {});
  ActuatorValues commands = run.positions();
  commands.ballasts_N = {9};
  commands.masses_m = {0.1};
  run.advance(commands, 60);
  EXPECT_DOUBLE_EQ(run.positions().ballasts_N[0], 2) << "its limit";
  const double rise_m_s =
      -(std::cos(run.body().euler_rad[1]) * std::cos(run.body().euler_rad[0]) * run.body().velocity[2] -
        std::sin(run.body().euler_rad[1]) * run.body().velocity[0] +
        std::cos(run.body().euler_rad[1]) * std::sin(run.body().euler_rad[0]) * run.body().velocity[1]);
  EXPECT_NEAR(rise_m_s, 2.0 / 20, 1e-4) << "equal damping in every direction";
  // Two of ten kilograms 0.1 m forward: the centre of gravity 0.02 m further.
  EXPECT_NEAR(run.body().euler_rad[1], -std::atan2(0.05, std::hypot(0.02, 0.05)), 1e-4);
}

TEST(HullDamping, NeverDrivesTheVehicle) {
  config::Layout layout = brick();
  layout.damping.axial_coefficient = 0.3;
  layout.damping.axial_area_m2 = 0.01;
  layout.damping.cross_flow_coefficient = 1.1;
  layout.damping.strips = {{-0.3, 0, 0.3}, {0.3, 0.3, 0.3}, {0.1, 0.2, 0.1}, {0.1, 0.3, 0.05}};
  layout.damping.flow_axes = config::LayoutFlowAxes{{0, 130}, {2, 25}, 20, 0, {}, 0, 0.5};
  layout.damping.linear[0] = 3;
  layout.damping.quadratic[35] = 2;
  const HullDamping hull(layout);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    Vector6 nu;
    for (double& component : nu) component = normal(random);
    EXPECT_LE(hull(nu).dot(nu), 0) << nu.transpose();
  }
}

TEST(FlowAxes, LiftIsAcrossAndDragAgainstTheVelocity) {
  config::LayoutFlowAxes flow;
  flow.drag_kg_m = {2, 0};
  flow.lift_kg_m = {0, 100};
  Vector6 nu = Vector6::Zero();
  nu[0] = 1;
  nu[2] = 0.1;
  const Vector6 force = flow_axes_force(flow, nu);
  const double V2 = 1.01, alpha = std::atan2(0.1, 1);
  EXPECT_NEAR(force.head<3>().dot(nu.head<3>()) / std::sqrt(V2), -2 * V2, 1e-12);
  EXPECT_NEAR(-force[2] * 1 + force[0] * 0.1, 100 * alpha * V2 * std::sqrt(V2), 1e-9);
  EXPECT_TRUE(flow_axes_force(flow, Vector6::Zero()).isZero(0));
}

TEST(AddedMass, StripsOfASpheroidComeNearLamb) {
  config::Layout by_strips = brick(), by_lamb = brick();
  by_lamb.added_mass.spheroid = {2, 0.2};
  for (int i = 0; i < 100; ++i) {
    const double x = -1 + (i + 0.5) * 0.02;
    by_strips.added_mass.strips.x_m.push_back(x);
    by_strips.added_mass.strips.length_m.push_back(0.02);
    by_strips.added_mass.strips.width_m.push_back(0.2 * std::sqrt(1 - x * x));
    by_strips.added_mass.strips.height_m.push_back(0.2 * std::sqrt(1 - x * x));
  }
  const Matrix6 strips = added_mass(by_strips), lamb = added_mass(by_lamb);
  EXPECT_NEAR(strips(1, 1) / lamb(1, 1), 1, 0.06) << "slender: strips have no ends";
  EXPECT_NEAR(strips(4, 4) / lamb(4, 4), 1, 0.2);
  EXPECT_NEAR(strips(2, 4), 0, 1e-9);
  EXPECT_TRUE(strips.isApprox(strips.transpose()));
}

TEST(ThrustCurve, APropellerFollowsItsCoefficients) {
  const auto thruster = propeller();
  // n = 10 rev/s, u_a = 0.5 m/s: J = 0.5.
  EXPECT_NEAR(autopilot::thrust_at(thruster, 1000, 600, 0.5).force_N, 1000 * 100 * 1e-4 * 0.25, 1e-12);
  EXPECT_NEAR(autopilot::thrust_at(thruster, 1000, 600, 0.5).torque_Nm, -1000 * 100 * 1e-5 * 0.03, 1e-12);
  EXPECT_NEAR(autopilot::thrust_at(thruster, 1000, -600, 0.5).force_N, -0.6 * 1000 * 100 * 1e-4 * 0.4, 1e-12);
  EXPECT_EQ(autopilot::thrust_at(thruster, 1000, 600, 5).force_N, 0) << "no brake";
  EXPECT_EQ(autopilot::thrust_at(thruster, 1000, 0, 1).force_N, 0);
}

TEST(ThrustCurve, ATableIsInterpolatedAndLosesForceUnderWay) {
  const auto thruster = esc();
  EXPECT_NEAR(autopilot::thrust_at(thruster, 1000, 1715, 0).force_N, 25, 1e-12);
  EXPECT_NEAR(autopilot::thrust_at(thruster, 1000, 1715, 1).force_N, 25 - 1.5 * 5, 1e-12);
  EXPECT_NEAR(autopilot::thrust_at(thruster, 1000, 1900, -1).force_N, 50 + 1.5 * std::sqrt(50), 1e-12);
  EXPECT_EQ(autopilot::thrust_at(thruster, 1000, 1715, 10).force_N, 0);
  EXPECT_EQ(autopilot::thrust_at(thruster, 1000, 5000, 0).force_N, 50);
  EXPECT_EQ(autopilot::effective_command(thruster, 1520), 1500);
  EXPECT_EQ(autopilot::effective_command(thruster, 2500), 1900);
}

TEST(ThrustCurve, ACommandActsInPartWhereADeadBandHasASoftEnd) {
  auto thruster = esc();
  thruster.dead_band_edge = 8;
  const double band = thruster.dead_band;
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(autopilot::effective_command(thruster, 1500 + sign * (band - 8)), 1500);
    EXPECT_NEAR(autopilot::effective_command(thruster, 1500 + sign * band), 1500 + sign * band / 2, 1e-9);
    EXPECT_NEAR(autopilot::effective_command(thruster, 1500 + sign * (band + 8)), 1500 + sign * (band + 8), 1e-9);
    double last = 0;
    for (double away = 0; away < 2 * band; away += 0.1) {
      const double acts = sign * (autopilot::effective_command(thruster, 1500 + sign * away) - 1500);
      EXPECT_GE(acts, last);
      EXPECT_LT(acts - last, 1) << "no jump";
      last = acts;
    }
  }
}

TEST(ThrustCurve, TheCommandForAForceGivesIt) {
  for (const auto& thruster : {propeller(), esc()}) {
    for (const double advance_m_s : {-0.5, 0.0, 0.7}) {
      const auto force_at = [&](double command) {
        return autopilot::thrust_at(thruster, 1000, autopilot::effective_command(thruster, command), advance_m_s)
            .force_N;
      };
      const double least = force_at(thruster.low), most = force_at(thruster.high);
      for (double part = -0.5; part <= 1.5; part += 0.05) {
        const double wanted = least + part * (most - least);
        const double command = autopilot::command_for(thruster, 1000, wanted, advance_m_s);
        EXPECT_GE(command, thruster.low);
        EXPECT_LE(command, thruster.high);
        EXPECT_NEAR(force_at(command), std::clamp(wanted, least, most), 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace navcal::sim::testing
