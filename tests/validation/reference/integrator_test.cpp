// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "validation/reference/vehicle.h"

namespace navcal::reference::testing {
namespace {

/// A hull without drive and damping, and without fins.
Hull frictionless() {
  Hull hull;
  hull.axial_drag = hull.crossflow_drag = hull.lift_slope_per_rad = 0;
  hull.fin_lift_slope_per_rad = hull.fin_induced_drag = 0;
  hull.roll_damping_ratio = hull.pitch_damping_ratio = hull.yaw_damping_per_s = 0;
  return hull;
}

Start tumbling() {
  Start start;
  start.velocity_m_s = {1.0, 0.2, -0.1};
  start.rate_rad_s = {0.5, 0.3, -0.4};
  start.world_from_body = attitude(0.2, -0.3, 1);
  return start;
}

/// Under way without a flow so slanting that a fin reaches its limit, where forces have a kink.
Start gentle() {
  Start start;
  start.velocity_m_s = {1.1, 0.05, -0.03};
  start.rate_rad_s = {0.1, 0.05, -0.1};
  return start;
}

TEST(DormandPrince, IsOfTheFifthOrder) {
  // y' = y cos t, y(0) = 1: y = exp(sin t)
  const auto error = [](int steps) {
    double y = 1;
    const double h = 2.0 / steps;
    for (int i = 0; i < steps; ++i)
      y = dormand_prince(i * h, y, h, [](double t, double value) { return value * std::cos(t); });
    return std::abs(y - std::exp(std::sin(2.0)));
  };
  EXPECT_NEAR(std::log2(error(10) / error(20)), 5, 0.5);
  EXPECT_NEAR(std::log2(error(20) / error(40)), 5, 0.5);
}

TEST(Vehicle, ConvergesAtLeastInTheFifthOrder) {
  const auto end = [](double step_s) {
    Hull hull;
    hull.crossflow_drag = 0;  // it has a kink wherever the flow across a station turns
    Vehicle vehicle(hull, {}, gentle(), step_s);
    vehicle.hold(13, {-0.1, 0.07, 0.04});
    vehicle.advance(1.6);
    return vehicle.snapshot();
  };
  const Snapshot exact = end(0.002);
  const auto error = [&](double step_s) { return (end(step_s).position_m - exact.position_m).norm(); };
  EXPECT_GT(std::log2(error(0.04) / error(0.02)), 4.8);  // the term of the sixth power is small in this formula
  EXPECT_LT(error(Vehicle::kStep_s), 1e-11);
}

TEST(Vehicle, KeepsItsEnergyWhereNothingDrivesAndNothingDamps) {
  Vehicle vehicle(frictionless(), {}, tumbling());
  const double before_J = vehicle.energy_J();
  for (int i = 1; i <= 60; ++i) {
    vehicle.advance(i);
    ASSERT_NEAR(vehicle.energy_J(), before_J, 1e-8 * std::abs(before_J)) << i << " s";
  }
}

TEST(Vehicle, ThePathOfAMomentumWithoutForceIsStraight) {
  // The momentum of body and water is fixed in the world: what turns the body moves it sideways and back.
  Hull hull = frictionless();
  hull.gravity_centre_below_m = 0;
  Vehicle vehicle(hull, {}, tumbling());
  const Matrix6 M = inertia(hull);
  const auto momentum = [&](const Snapshot& s) {
    Vector6 nu;
    nu << s.velocity_m_s, s.rate_rad_s;
    return Vector3(s.world_from_body * Vector3((M * nu).head<3>()));
  };
  const Vector3 before = momentum(vehicle.snapshot());
  vehicle.advance(30);
  EXPECT_LT((momentum(vehicle.snapshot()) - before).norm(), 1e-9 * before.norm());
}

TEST(Vehicle, StepsEndWhereTheyAreAskedTo) {
  Vehicle coarse(Hull{}, {}, gentle()), fine(Hull{}, {}, gentle());
  coarse.command(13, {0.1, 0, 0});
  fine.command(13, {0.1, 0, 0});
  coarse.advance(1.0);
  for (const double t : {0.0001, 0.3337, 0.3338, 0.71, 1.0}) fine.advance(t);
  EXPECT_DOUBLE_EQ(fine.time_s(), 1.0);
  EXPECT_LT((coarse.snapshot().position_m - fine.snapshot().position_m).norm(), 1e-6);
}

TEST(Vehicle, WhatAnAccelerometerFeelsIsTheDerivativeOfTheVelocity) {
  Vehicle vehicle(Hull{}, {}, tumbling());
  vehicle.command(16, {0.2, -0.1, 0.05});
  vehicle.advance(0.999);
  const Snapshot before = vehicle.snapshot();
  vehicle.advance(1.0);
  const Snapshot now = vehicle.snapshot();
  vehicle.advance(1.001);
  const Snapshot after = vehicle.snapshot();
  const Vector3 world = (after.ground_velocity_m_s() - before.ground_velocity_m_s()) / 0.002;
  EXPECT_LT((now.world_from_body * now.acceleration_m_s2 - world).norm(), 1e-4);
}

}  // namespace
}  // namespace navcal::reference::testing
