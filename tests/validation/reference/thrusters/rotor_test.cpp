// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/rotor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/validation/reference/thrusters/shipped_plan.h"

namespace navcal::reference::thrusters::testing {
namespace {

constexpr double kShortStep_s = 1e-4;

struct Spun {
  double speed = 0, wake = 0;
};

/// The rotor `duration_s` later, by steps of Euler that are far shorter than its lag.
Spun spun(const Rotor& rotor, Spun from, double duration_s, double sag = 0) {
  for (double t = 0; t < duration_s; t += kShortStep_s) {
    const Rotor::Rates rates = rotor.rates(from.speed, from.wake, t, sag);
    from.speed += kShortStep_s * rates.speed;
    from.wake += kShortStep_s * rates.wake;
  }
  return from;
}

double steady_thrust_N(Rotor rotor, double command, double advance_m_s = 0) {
  rotor.order(command);
  const Spun end = spun(rotor, {}, 4);
  return rotor.push(end.speed, end.wake, 0, advance_m_s, 0, 0).force_N;
}

PlannedThruster t200() { return shipped_plan("bluerov2-heavy").thrusters.front(); }

TEST(Rotor, SteadyThrustAtRestIsTheLayouts) {
  for (const char* const name : kThrusterLayouts) {
    const Plan plan = shipped_plan(name);
    const PlannedThruster& thruster = plan.thrusters.front();
    const Rotor rotor(thruster, plan.density_kg_m3, {}, {});
    for (const double part : {-1.0, -0.6, -0.2, 0.0, 0.15, 0.5, 1.0}) {
      const double side = part < 0 ? thruster.neutral() - thruster.low : thruster.high - thruster.neutral();
      const double command = thruster.neutral() + part * side;
      const double stated_N = thruster.bollard_N(command, plan.density_kg_m3);
      EXPECT_NEAR(steady_thrust_N(rotor, command), stated_N, 1e-3 * std::abs(stated_N) + 1e-6)
          << name << ' ' << command;
    }
  }
}

TEST(Rotor, ThrustFallsWithTheAdvanceAsTheLayoutStates) {
  const Plan plan = shipped_plan("micro-auv");
  const Rotor rotor(plan.thrusters.front(), plan.density_kg_m3, {}, {});
  EXPECT_NEAR(steady_thrust_N(rotor, 100, 0.8), 2 - 0.5 * std::sqrt(2.0) * 0.8, 1e-3);
  EXPECT_NEAR(steady_thrust_N(rotor, 10, 5), 0, 1e-12) << "it does not brake";
}

TEST(Rotor, AtHalfSpeedItsLagIsTheLayouts) {
  const PlannedThruster thruster = t200();
  Rotor rotor(thruster, 1000, {}, {});
  // Half speed gives a quarter of the thrust: 12.9 N lies between 1700 and 1800 us.
  rotor.order(1710.2);
  const double half = spun(rotor, {}, 4).speed;
  EXPECT_NEAR(half, 0.5, 0.01);
  const Spun near = spun(rotor, {half - 0.02, half}, thruster.lag_s);
  EXPECT_NEAR((half - near.speed) / 0.02, std::exp(-1), 0.02);
}

TEST(Rotor, ThrustOvershootsUntilTheWakeIsThere) {
  Rotor rotor(t200(), 1000, {}, {});
  rotor.order(1900);
  const Spun early = spun(rotor, {0.9, 0.9}, 0.002), late = spun(rotor, {1, 1}, 1);
  EXPECT_NEAR(rotor.push(late.speed, late.wake, 0, 0, 0, 0).force_N, 51.5, 0.01);
  EXPECT_GT(rotor.push(1, 0.5, 0, 0, 0, 0).force_N, 51.5 * 1.05);
  EXPECT_GT(early.speed, early.wake);
}

TEST(Rotor, FaultsDoWhatTheySay) {
  const PlannedThruster thruster = t200();
  const auto with = [&](RotorDeviations deviations) { return Rotor(thruster, 1000, deviations, {}); };
  EXPECT_NEAR(steady_thrust_N(with({.scale = -0.3}), 1900), 0.7 * 51.5, 0.06);
  EXPECT_NEAR(steady_thrust_N(with({.offset = 0.25}), 1600), 11.2, 0.02);
  EXPECT_EQ(steady_thrust_N(with({.dead_band = 0.2}), 1590), 0);
  EXPECT_NEAR(steady_thrust_N(with({.reversed = true}), 1700), -8.71, 0.01);
  EXPECT_EQ(steady_thrust_N(with({.dead = true}), 1900), 0);
  Rotor lagging = with({.lag_s = 0.5});
  lagging.order(1900);
  Rotor quick = with({});
  quick.order(1900);
  EXPECT_LT(spun(lagging, {}, 0.3).speed, 0.7 * spun(quick, {}, 0.3).speed);
}

TEST(Rotor, TheReactionTurnsTheHullAgainstTheHand) {
  const Plan plan = shipped_plan("micro-auv");
  for (const PlannedThruster& thruster : plan.thrusters) {
    Rotor rotor(thruster, 1000, {}, {});
    rotor.order(100);
    const double moment = rotor.push(1, 1, 0, 0, 0, 0).moment_Nm;
    EXPECT_NEAR(moment, thruster.reaction_sign * 2 * 0.008, 1e-9);
  }
}

TEST(Rotor, AFlowAcrossTakesALittleAndASaggingSupplyMore) {
  const Rotor rotor(t200(), 1000, {}, {});
  EXPECT_LT(rotor.push(0.5, 0.5, 0, 0, 1, 0).force_N, rotor.push(0.5, 0.5, 0, 0, 0, 0).force_N);
  EXPECT_GT(rotor.push(0.5, 0.5, 0, 0, 1, 0).force_N, 0.97 * rotor.push(0.5, 0.5, 0, 0, 0, 0).force_N);
  Rotor weak = rotor;
  weak.order(1900);
  EXPECT_LT(spun(weak, {}, 3, 0.2).speed, 0.9);
}

}  // namespace
}  // namespace navcal::reference::thrusters::testing
