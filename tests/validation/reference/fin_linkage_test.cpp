// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>

#include "validation/reference/vehicle.h"

namespace navcal::reference::testing {
namespace {

constexpr double kServo_s = 0.15;
constexpr double kDegrees = 180 / std::numbers::pi;

/// The equations of both lags by many small steps of the trapezoid rule.
double lagged_by_steps(double command, double gain, double lag_s, double time_s) {
  constexpr int kSteps = 20000;
  const double h = time_s / kSteps;
  double servo = 0, lagged = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double next = (servo * (1 - h / 2 / kServo_s) + h / kServo_s * command) / (1 + h / 2 / kServo_s);
    lagged = (lagged * (1 - h / 2 / lag_s) + h / 2 / lag_s * gain * (servo + next)) / (1 + h / 2 / lag_s);
    servo = next;
  }
  return lagged;
}

TEST(FinLinkage, NominallyTheFinsStandAsTheServosDo) {
  FinLinkage linkage(kServo_s, {});
  linkage.command({0.2, -0.1, 0.3});
  for (const double t : {0.0, 0.05, 0.4}) {
    EXPECT_LT((linkage.fins_rad(t) - linkage.servos_rad(t)).norm(), 1e-15);
    EXPECT_NEAR(linkage.servos_rad(t)(0), 0.2 * (1 - std::exp(-t / kServo_s)), 1e-15);
  }
}

TEST(FinLinkage, ClosedFormOfBothLagsSolvesTheirEquations) {
  for (const double lag_s : {0.05, kServo_s, kServo_s * (1 + 1e-12), 0.2, 3.0}) {
    VehicleDeviations deviations;
    deviations.fin_lag_s = lag_s;
    deviations.fin_gain = 0.08;
    FinLinkage linkage(kServo_s, deviations);
    linkage.command({0.3, 0, 0});
    EXPECT_NEAR(linkage.fins_rad(0.25)(0), lagged_by_steps(0.3, 1.08, lag_s, 0.25), 1e-7) << lag_s;
  }
}

TEST(FinLinkage, SettlingOnTheWayChangesNothing) {
  VehicleDeviations deviations;
  deviations.fin_lag_s = 0.2;
  FinLinkage whole(kServo_s, deviations), parts(kServo_s, deviations);
  whole.command({0.3, -0.2, 0.1});
  parts.command({0.3, -0.2, 0.1});
  for (int i = 0; i < 100; ++i) parts.settle(0.004);
  EXPECT_LT((whole.fins_rad(0.4) - parts.fins_rad(0)).norm(), 1e-12);
}

TEST(FinLinkage, AVanishingLagIsNoLag) {
  VehicleDeviations deviations;
  deviations.fin_lag_s = 1e-12;
  FinLinkage linkage(kServo_s, deviations);
  linkage.command({0.3, 0, 0});
  linkage.settle(0.004);
  EXPECT_NEAR(linkage.fins_rad(0.004)(0), linkage.servos_rad(0.004)(0), 1e-9);
}

TEST(FinLinkage, PlayHoldsTheFinUntilItIsTakenUp) {
  VehicleDeviations deviations;
  deviations.fin_backlash_rad = 2 / kDegrees;
  FinLinkage linkage(kServo_s, deviations);
  const auto fin_after = [&](double angle_deg) {
    linkage.command({angle_deg / kDegrees, 0, 0});
    for (int i = 0; i < 1000; ++i) linkage.settle(0.004);
    return linkage.fins_rad(0)(0) * kDegrees;
  };
  EXPECT_NEAR(fin_after(0.9), 0, 1e-9);
  EXPECT_NEAR(fin_after(10), 9, 1e-6);
  EXPECT_NEAR(fin_after(8.5), 9, 1e-6);
  EXPECT_NEAR(fin_after(5), 6, 1e-6);
  EXPECT_NEAR(fin_after(-10), -9, 1e-6);
}

TEST(FinLinkage, RudderAndElevatorMixAsTheCardHasIt) {
  const Vector3 fins = FinLinkage::mixed(0.1, 0.2);
  EXPECT_NEAR(2.0 / 3 * ((fins(1) + fins(2)) / 2 - fins(0)), 0.1, 1e-15);
  EXPECT_NEAR((fins(1) - fins(2)) / std::sqrt(3.0), 0.2, 1e-15);
  VehicleDeviations deviations;
  deviations.rudder_rad = 0.1;
  deviations.elevator_rad = 0.2;
  EXPECT_LT((FinLinkage(kServo_s, deviations).fins_rad(1) - fins).norm(), 1e-15);
}

TEST(FinLinkage, CommandsEndAtTheServosStops) {
  FinLinkage linkage(kServo_s, {});
  linkage.command({1, -1, 0});
  EXPECT_NEAR(linkage.servos_rad(100)(0) * kDegrees, 25, 1e-9);
  EXPECT_NEAR(linkage.servos_rad(100)(1) * kDegrees, -25, 1e-9);
}

}  // namespace
}  // namespace navcal::reference::testing
