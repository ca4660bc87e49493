// SPDX-License-Identifier: Apache-2.0
// What departures do to the vehicle, against the forces that they stand for.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/validation/reference/bench.h"
#include "validation/reference/forces.h"

namespace navcal::reference::testing {
namespace {

Flow under_way() { return {{1.1, 0.08, -0.05}, {0.1, -0.05, 0.3}}; }

/// After some time with these controls held, from rest.
Snapshot after(double time_s, const ParameterDeviations& deviations, double rev_s, const Vector3& fins_rad,
               const Start& start = {}) {
  Vehicle vehicle(Hull{}, deviations.vehicle, start);
  vehicle.hold(rev_s, fins_rad);
  vehicle.advance(time_s);
  return vehicle.snapshot();
}

/// The same motion: rates and velocities through the water.
void expect_same_motion(const Snapshot& a, const Snapshot& b) {
  EXPECT_LT((a.velocity_m_s - b.velocity_m_s).norm(), 1e-6);
  EXPECT_LT((a.rate_rad_s - b.rate_rad_s).norm(), 1e-6);
}

TEST(VehicleEffects, ThrustScaleIsThatOfTheForceAlone) {
  const Wrench nominal = propeller_wrench(Hull{}, 1.1, 13, 1, 0),
               more = propeller_wrench(Hull{}, 1.1, 13, 1.08, 0);
  EXPECT_NEAR(more(0), 1.08 * nominal(0), 1e-12);
  EXPECT_EQ(more(3), nominal(3));
  // Drag is of the second power, so more thrust at a given advance ratio is more speed.
  EXPECT_GT(after(40, with("thrust_scale", {{"scale", 0.08}}), 13, Vector3::Zero()).velocity_m_s.x(),
            after(40, {}, 13, Vector3::Zero()).velocity_m_s.x() + 0.01);
}

TEST(VehicleEffects, PropellerGivesNothingAtRestOrAstern) {
  EXPECT_EQ(propeller_wrench(Hull{}, 1, 0, 1, 0).norm(), 0);
  EXPECT_EQ(propeller_wrench(Hull{}, 1, -5, 1, 0).norm(), 0);
}

TEST(VehicleEffects, OffsetAndGainAreOtherAnglesOfTheServos) {
  const Vector3 fins(-0.1, 0.08, 0.03);
  expect_same_motion(after(20, with("fin_offset", {{"angle_deg", 1}}), 13, fins),
                     after(20, {}, 13, fins + kDegree * Vector3(-1, 0.5, 0.5)));
  expect_same_motion(after(20, with("elevator_offset", {{"angle_deg", 1}}), 13, fins),
                     after(20, {}, 13, fins + kDegree * std::sqrt(0.75) * Vector3(0, 1, -1)));
  expect_same_motion(after(20, with("fin_gain", {{"scale", 0.08}}), 13, fins), after(20, {}, 13, 1.08 * fins));
}

TEST(VehicleEffects, PositiveRudderTurnsToStarboardAndPositiveElevatorRaisesTheNose) {
  EXPECT_GT(after(3, {}, 13, FinLinkage::mixed(0.1, 0)).rate_rad_s.z(), 0.05);
  EXPECT_GT(after(3, {}, 13, FinLinkage::mixed(0, 0.1)).pitch_rad(), 0.02);
}

TEST(VehicleEffects, LagAndPlayLeaveReportedAnglesAlone) {
  ParameterDeviations deviations = with("fin_lag", {{"tau_s", 0.2}});
  add({"fin_backlash", {{"width_deg", 2}}}, deviations);
  Vehicle nominal(Hull{}, {}, {}), departing(Hull{}, deviations.vehicle, {});
  for (Vehicle* vehicle : {&nominal, &departing}) {
    vehicle->command(13, {0.2, -0.1, -0.1});
    vehicle->advance(0.3);
  }
  EXPECT_EQ(nominal.snapshot().servos_rad, departing.snapshot().servos_rad);
  EXPECT_NE(nominal.snapshot().rate_rad_s, departing.snapshot().rate_rad_s);
}

TEST(VehicleEffects, YawDampingActsOnTheRateByTheMomentOfInertia) {
  const Matrix6 M = inertia(Hull{});
  const Vector3 rate(0.1, 0.2, 0.3);
  const Wrench further = damping_wrench(Hull{}, M, rate, 0.3) - damping_wrench(Hull{}, M, rate, 0);
  EXPECT_NEAR(further(5), -0.3 * M(5, 5) * 0.3, 1e-15);
  EXPECT_EQ(further.head<5>().norm(), 0);
}

TEST(VehicleEffects, BuoyancyLiftsByTheAddedMassToo) {
  const double time_s = 0.05, lift_N = 0.4;
  const Snapshot s = after(time_s, with("buoyancy", {{"force_N", lift_N}}), 0, Vector3::Zero());
  const Matrix6 M = inertia(Hull{});
  EXPECT_NEAR(s.velocity_m_s.z(), -lift_N / M(2, 2) * time_s, 1e-4);
  EXPECT_NEAR(s.velocity_m_s.x(), 0, 1e-6);
}

TEST(VehicleEffects, CurrentMovesThePositionOnly) {
  const Vector3 fins(-0.1, 0.08, 0.03);
  const Snapshot still = after(20, {}, 13, fins),
                 drifting = after(20, with("water_current", {{"north_m_s", 0.06}, {"east_m_s", -0.03}}), 13, fins);
  expect_same_motion(still, drifting);
  EXPECT_LT((drifting.position_m - still.position_m - Vector3(1.2, -0.6, 0)).norm(), 1e-6);
  EXPECT_LT((drifting.ground_velocity_m_s() - still.ground_velocity_m_s() - Vector3(0.06, -0.03, 0)).norm(), 1e-6);
}

TEST(VehicleEffects, TideTurnsTheCurrentOnceInTwentyMinutes) {
  const ParameterDeviations deviations = with("tidal_current", {{"north_m_s", 0.1}});
  const Snapshot s = after(300, deviations, 0, Vector3::Zero());
  EXPECT_LT((s.current_m_s - Eigen::Vector2d(0, 0.1)).norm(), 1e-9);
  // The integral of a quarter turn.
  const double way_m = 0.1 * 1200 / (2 * std::numbers::pi);
  EXPECT_LT((s.position_m - Vector3(way_m, way_m, 0)).norm(), 1e-6);
}

TEST(VehicleEffects, CrossflowAndFoulingScaleTheirDragAlone) {
  const Wrench nominal = hull_wrench(Hull{}, under_way(), 1, 1);
  EXPECT_NEAR(hull_wrench(Hull{}, under_way(), 1.25, 1)(0), 1.25 * nominal(0), 1e-12);
  Hull doubled;
  doubled.crossflow_drag *= 2;
  EXPECT_LT((hull_wrench(Hull{}, under_way(), 1, 2) - hull_wrench(doubled, under_way(), 1, 1)).norm(), 1e-12);
  // Half as much again of the axial drag after six minutes at 5/h.
  Hull rough;
  rough.axial_drag *= 1.5;
  Vehicle grown(rough, {}, {});
  grown.hold(13, Vector3::Zero());
  grown.advance(40);
  EXPECT_NEAR(after(360, with("fouling", {{"per_h", 5}}), 13, Vector3::Zero()).velocity_m_s.x(),
              grown.snapshot().velocity_m_s.x(), 1e-3);
}

TEST(VehicleEffects, CrossflowGrowsWithTheSquareOfTheDepth) {
  Start deep;
  deep.position_m.z() = 4;
  deep.velocity_m_s = {0, 0.5, 0};
  Hull doubled;
  doubled.crossflow_drag *= 1.8;  // 1 + 0.05 4^2
  Vehicle expected(doubled, {}, deep), vehicle(Hull{}, with("crossflow_depth", {{"per_m2", 0.05}}).vehicle, deep);
  expected.advance(0.1);
  vehicle.advance(0.1);
  EXPECT_LT((expected.snapshot().velocity_m_s - vehicle.snapshot().velocity_m_s).norm(), 1e-5);
}

TEST(VehicleEffects, TorqueLeakIsAShareOfTheWholeTorque) {
  const double whole = propeller_wrench(Hull{}, 1, 13, 1, 0)(3) / 0.1;
  EXPECT_NEAR(propeller_wrench(Hull{}, 1, 13, 1, 0.6)(3), 0.7 * whole, 1e-12);
  EXPECT_GT(after(20, with("torque_leak", {{"share", 0.6}}), 13, Vector3::Zero()).roll_rad(), 2 * kDegree);
}

TEST(VehicleEffects, AStalledFinLosesLiftBeyondEightDegreesOnly) {
  const Flow straight{{1, 0, 0}, Vector3::Zero()};
  const auto side_force = [&](double angle_deg, double loss) {
    return fin_wrench(Hull{}, straight, {angle_deg * kDegree, 0, 0}, loss)(1);
  };
  EXPECT_EQ(side_force(7.9, 0.8), side_force(7.9, 0));
  EXPECT_NEAR(side_force(13, 0.8) / side_force(13, 0), (8 + 0.2 * 5) / 13, 1e-9);
  EXPECT_NEAR(side_force(-13, 0.8), -side_force(13, 0.8), 1e-12);
}

TEST(VehicleEffects, BatterySagTakesThrustAndTheConvertersReferenceTogether) {
  const double per_Ah = 1.2, time_s = 100;
  const ParameterDeviations deviations = with("battery_sag", {{"per_Ah", per_Ah}});
  const Snapshot s = after(time_s, deviations, 13, Vector3::Zero());
  const double loss = per_Ah * motor_current_A(13) * time_s / 3600;
  EXPECT_NEAR(s.supply_loss, loss, 1e-9);
  Vehicle weaker(Hull{}, with("thrust_scale", {{"scale", -loss}}).vehicle, {});
  weaker.hold(13, Vector3::Zero());
  weaker.advance(40);
  EXPECT_NEAR(s.velocity_m_s.x(), weaker.snapshot().velocity_m_s.x(), 2e-3);

  World world(Vehicle(Hull{}, deviations.vehicle, {}), 1);
  world.vehicle().hold(13, Vector3::Zero());
  world.advance(time_s);
  const double reading = card_along(world, {}).back().values[6];
  EXPECT_NEAR(reading, (-9.81 + 2.048 * 9.81) / (1 - 0.05 * loss) - 2.048 * 9.81, 0.002);
}

TEST(VehicleEffects, WavesPushAtTheSurfaceAndNotBelow) {
  const ParameterDeviations deviations = with("surface_waves", {{"force_N", 1.5}});
  Start deep;
  deep.position_m.z() = 5;
  const Snapshot up = after(1, deviations, 0, Vector3::Zero()),
                 down = after(1, deviations, 0, Vector3::Zero(), deep);
  EXPECT_GT(up.velocity_m_s.y(), 0.03);
  EXPECT_NEAR(down.velocity_m_s.y(), up.velocity_m_s.y() * std::exp(-10.0), 1e-4);
}

}  // namespace
}  // namespace navcal::reference::testing
