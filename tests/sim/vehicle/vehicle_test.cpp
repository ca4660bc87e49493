// SPDX-License-Identifier: Apache-2.0
// The reference vehicle as its layout.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <string>

#include "autopilot/autopilot.h"
#include "tests/sim/vehicle/runs.h"

namespace navcal::sim::testing {
namespace {

const LayoutVehicle kVehicle{layout_of({})};

TEST(Vehicle, ItsMassMatrixIsThatOfABody) {
  const Matrix6& mass = kVehicle.mass();
  EXPECT_EQ(mass, mass.transpose());
  EXPECT_EQ(Eigen::LLT<Matrix6>(mass).info(), Eigen::Success) << "positive definite";
  EXPECT_GT(mass(1, 1), mass(0, 0)) << "the Munk moment needs more added mass across than along";
  EXPECT_NEAR(mass(0, 4), 0.053, 1e-12) << "m zg couples surge and pitch";
  EXPECT_NEAR(mass(1, 3), -0.053, 1e-12);
}

TEST(Vehicle, AtRestItStaysAtRest) {
  const Body after = held(kVehicle, {}, {}, 10);
  EXPECT_LT(after.velocity.norm(), 1e-12);
  EXPECT_LT(after.position_m.norm(), 1e-12);
}

TEST(Vehicle, HeelingAndPitchingDieAwayWithoutWay) {
  Body tilted;
  tilted.euler_rad = {0.3, 0.2, 0};
  const Body after = held(kVehicle, tilted, {}, 30);
  EXPECT_LT(after.euler_rad.head<2>().norm(), 1e-2);
}

TEST(Vehicle, TheWorldHasNoPreferredHeading) {
  const Controls controls{{-0.2, 0.15, 0.05}, 13};
  Body turned = under_way(0.5);
  turned.euler_rad.z() = 1;
  const Body a = held(kVehicle, under_way(0.5), controls, 10);
  const Body b = held(kVehicle, turned, controls, 10);
  EXPECT_LT((a.velocity - b.velocity).norm(), 1e-9);
  EXPECT_NEAR(b.euler_rad.z() - a.euler_rad.z(), 1, 1e-9);
  EXPECT_NEAR(b.position_m.x(), std::cos(1) * a.position_m.x() - std::sin(1) * a.position_m.y(), 1e-8);
}

TEST(Vehicle, PortAndStarboardAreMirrorImagesButForThePropellersTorque) {
  config::VehicleSettings settings;
  settings.propeller.torque_felt = 0;
  const LayoutVehicle vehicle(layout_of(settings));
  // A mirror exchanges the second and third fin and turns every angle about.
  const Body starboard = held(vehicle, under_way(0.5), {{-0.3, 0.2, 0.05}, 13}, 20);
  const Body port = held(vehicle, under_way(0.5), {{0.3, -0.05, -0.2}, 13}, 20);
  Vector6 mirror;
  mirror << 1, -1, 1, -1, 1, -1;
  EXPECT_LT((starboard.velocity - mirror.cwiseProduct(port.velocity)).norm(), 1e-9);
  EXPECT_NEAR(starboard.position_m.y(), -port.position_m.y(), 1e-8);
  EXPECT_NEAR(starboard.position_m.z(), port.position_m.z(), 1e-8);
}

TEST(Vehicle, FinsTurnItAsTheMixingSays) {
  EXPECT_GT(held(kVehicle, under_way(1.1), {autopilot::mixed_fins(0.1, 0), 13}, 3).euler_rad.z(), 0.1)
      << "starboard";
  EXPECT_GT(held(kVehicle, under_way(1.1), {autopilot::mixed_fins(0, 0.1), 13}, 3).euler_rad.y(), 0.1)
      << "nose up";
  EXPECT_LT(held(kVehicle, under_way(1.1), {autopilot::mixed_fins(0, 0.1), 13}, 5).position_m.z(), -0.1);
}

struct Straight {
  double shaft_rps, speed_m_s;
};
class SteadySpeed : public ::testing::TestWithParam<Straight> {};

TEST_P(SteadySpeed, IsThatOfTheReferenceVehicle) {
  const auto [shaft_rps, speed_m_s] = GetParam();
  const Body body = held(kVehicle, under_way(0.05), {Eigen::Vector3d::Zero(), shaft_rps}, 60);
  EXPECT_NEAR(body.velocity[0] / speed_m_s, 1, 0.005);
}
INSTANTIATE_TEST_SUITE_P(Vehicle, SteadySpeed,
                         ::testing::Values(Straight{10, 0.872}, Straight{13, 1.134}, Straight{16, 1.395}));

TEST(Vehicle, FullRudderTurnsItAsTheReferenceVehicle) {
  const Controls full{Eigen::Vector3d(-25, 13.75, 13.75) / kDegrees, 13};
  const Body body = held(kVehicle, under_way(0.05), full, 120);
  const double roll = body.euler_rad.x(), pitch = body.euler_rad.y(), r = body.velocity[5];
  EXPECT_NEAR(r / 0.8070, 1, 0.005);
  EXPECT_NEAR((std::sin(roll) * body.velocity[4] + std::cos(roll) * r) / std::cos(pitch) / 0.8270, 1, 0.005);
  EXPECT_NEAR(body.velocity[0] / 0.948, 1, 0.005);
  EXPECT_NEAR(body.velocity.head<3>().norm() / r / 1.187, 1, 0.005);
  EXPECT_NEAR(roll * kDegrees, 3.0, 0.05);
  EXPECT_NEAR(pitch * kDegrees, -12.3, 0.05);
}

/// Nothing that takes or gives energy.
config::VehicleSettings lossless() {
  config::VehicleSettings settings;
  settings.hull.axial_drag = settings.hull.cross_flow_drag = settings.hull.lift_slope_per_rad = 0;
  settings.fins.area_m2 = 0;
  settings.damping = {0, 0, 0};
  return settings;
}

double energy_J(const LayoutVehicle& vehicle, const Body& body) {
  const config::HullSettings hull;
  return 0.5 * body.velocity.dot(vehicle.mass() * body.velocity) -
         hull.mass_kg * kGravity_m_s2 * hull.gravity_below_m * std::cos(body.euler_rad.x()) *
             std::cos(body.euler_rad.y());
}

/// Broadside, which the Munk moment makes the stable way; it rolls, pitches and yaws about that.
Body drifting() {
  Body body;
  body.velocity << 0.05, 0.6, 0.03, 0.02, 0.02, 0.1;
  body.euler_rad = {0.03, 0.03, 0};
  return body;
}

double energy_drift(double step_s, double seconds) {
  const LayoutVehicle vehicle(layout_of(lossless()));
  const double first_J = energy_J(vehicle, drifting());
  double worst = 0;
  Body body = drifting();
  for (double t = 0; t < seconds; t += 1) {
    body = held(vehicle, body, {}, 1, step_s);
    worst = std::max(worst, std::abs(energy_J(vehicle, body) / first_J - 1));
  }
  return worst;
}

TEST(Vehicle, KeepsItsEnergyWhereNothingTakesIt) {
  const double drift = energy_drift(0.01, 60);
  EXPECT_LT(drift, 1e-8);
  EXPECT_LT(energy_drift(0.005, 60), drift / 10) << "what is lost is the integrator's";
}

TEST(Vehicle, TheIntegratorConvergesWithTheFourthOrder) {
  const Controls controls{{-0.2, 0.15, 0.08}, 13};
  Body first = under_way(0.9);
  first.velocity.tail<5>() << 0.05, 0.03, 0.05, 0.02, 0.3;
  first.euler_rad = {0.1, 0.05, 0};
  const Body exact = held(kVehicle, first, controls, 1.6, 0.0005);
  const auto error = [&](double step_s) {
    const Body body = held(kVehicle, first, controls, 1.6, step_s);
    return (body.velocity - exact.velocity).norm() + (body.position_m - exact.position_m).norm() +
           (body.euler_rad - exact.euler_rad).norm();
  };
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 4, 0.3);
  EXPECT_NEAR(std::log2(error(0.01) / error(0.005)), 4, 0.2);
}

TEST(Vehicle, InfluencesDoWhatTheirNamesSay) {
  const Controls straight{Eigen::Vector3d::Zero(), 13};
  const Body plain = held(kVehicle, under_way(1), straight, 10);
  Influences current;
  current.current_m_s = {0.1, -0.2};
  const Body carried = held(kVehicle, under_way(1), straight, 10, 0.01, current);
  EXPECT_EQ(carried.velocity, plain.velocity);
  EXPECT_LT((carried.position_m - plain.position_m - Eigen::Vector3d(1, -2, 0)).norm(), 1e-9);
  Influences strong;
  strong.thrust_factor = 1.1;
  EXPECT_GT(held(kVehicle, under_way(1), straight, 10, 0.01, strong).velocity[0], plain.velocity[0] + 0.015);
  Influences light;
  light.buoyancy_N = 0.4;
  EXPECT_LT(held(kVehicle, {}, {}, 5, 0.01, light).position_m.z(), -0.1);
  Influences damped;
  damped.yaw_damping_per_s = 0.3;
  Body spinning;
  spinning.velocity[5] = 0.01;
  // At such a rate drag is nothing: N = -(0.15 + 0.3) M66 r.
  EXPECT_NEAR(held(kVehicle, spinning, {}, 1, 0.01, damped).velocity[5], 0.01 * std::exp(-0.45), 1e-4);
}

std::string complaint_about(const Body& body) {
  try {
    check_stable(body, 12.34);
  } catch (const UnstableVehicle& error) {
    return error.what();
  }
  return {};
}

TEST(Vehicle, InstabilityIsSaidWithTimeAndState) {
  EXPECT_EQ(complaint_about(under_way(2)), "");
  Body body = under_way(std::nan(""));
  EXPECT_NE(complaint_about(body).find("went unstable at t = 12.34 s"), std::string::npos)
      << complaint_about(body);
  body = under_way(1);
  body.euler_rad.y() = 1.55;
  EXPECT_NE(complaint_about(body).find("pitch 88.8"), std::string::npos) << complaint_about(body);
  body = {};
  body.velocity[4] = -1e3;
  EXPECT_NE(complaint_about(body).find("-1e+03"), std::string::npos) << complaint_about(body);
}

}  // namespace
}  // namespace navcal::sim::testing
