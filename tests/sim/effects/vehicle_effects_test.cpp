// SPDX-License-Identifier: Apache-2.0
// The vehicle's effects and those of noise, clocks and lines against their equations (docs/simulator.md).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "sim/effects/effect_set.h"
#include "tests/sim/effects/at_rest.h"

namespace navcal::sim::testing {
namespace {

Vector3 fins(EffectSet& set, const Vector3& servos, double time_s = 0) {
  Vector3 result = servos;
  set.link_fins(time_s, 0.01, result);
  return result;
}

EffectSet one(std::string_view name, std::initializer_list<double> values) {
  EffectSet set;
  set.add(effect_with(name, values));
  return set;
}

TEST(VehicleEffects, ForcesAndCurrent) {
  EffectSet set;
  set.add(effect_with("thrust_scale", {0.1}));
  set.add(effect_with("yaw_damping", {0.2}));
  set.add(effect_with("buoyancy", {0.3}), {10, 20});
  set.add(effect_with("water_current", {0.4, -0.5}));
  Influences on;
  set.influence(0, on);
  EXPECT_NEAR(on.thrust_factor, 1.1, 1e-12);
  EXPECT_EQ(on.yaw_damping_per_s, 0.2);
  EXPECT_EQ(on.buoyancy_N, 0) << "not yet";
  EXPECT_EQ(on.current_m_s, (std::array{0.4, -0.5}));
  Influences later;
  set.influence(15, later);
  EXPECT_EQ(later.buoyancy_N, 0.3);
}

TEST(VehicleEffects, OffsetsAreThoseOfRudderAndElevator) {
  EffectSet rudder = one("fin_offset", {2});
  const Vector3 r = fins(rudder, {});
  EXPECT_NEAR(2.0 / 3 * ((r[1] + r[2]) / 2 - r[0]), 2 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(r[1] - r[2], 0, 1e-12);
  EffectSet elevator = one("elevator_offset", {2});
  const Vector3 e = fins(elevator, {});
  EXPECT_NEAR((e[1] - e[2]) / std::numbers::sqrt3, 2 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(e[0], 0, 1e-12);
}

TEST(VehicleEffects, BacklashActsAtReversalsOnly) {
  EffectSet set = one("fin_backlash", {2});
  EXPECT_EQ(fins(set, {0, 0, 0})[0], 0);
  EXPECT_NEAR(fins(set, {0.5 * base::kRadiansPerDegree, 0, 0})[0], 0, 1e-12) << "within the play";
  EXPECT_NEAR(fins(set, {5 * base::kRadiansPerDegree, 0, 0})[0], 4 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(fins(set, {3.5 * base::kRadiansPerDegree, 0, 0})[0], 4 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(fins(set, {-5 * base::kRadiansPerDegree, 0, 0})[0], -4 * base::kRadiansPerDegree, 1e-12);
}

TEST(VehicleEffects, LagBeginsSettledAndFollowsWithItsTimeConstant) {
  EffectSet set = one("fin_lag", {0.2});
  EXPECT_EQ(fins(set, {0.1, 0, 0})[0], 0.1);
  double fin = 0;
  for (int i = 1; i <= 20; ++i) fin = fins(set, {0.2, 0, 0}, 0.01 * i)[0];
  EXPECT_NEAR(fin, 0.2 - 0.1 / std::numbers::e, 1.5e-3) << "the first step is a ramp";
}

TEST(VehicleEffects, OrderIsGainThenPlayThenOffset) {
  EffectSet set;
  set.add(effect_with("fin_offset", {-3}));
  set.add(effect_with("fin_backlash", {2}));
  set.add(effect_with("fin_gain", {1}));
  fins(set, {});
  EXPECT_NEAR(fins(set, {2 * base::kRadiansPerDegree, 0, 0})[0], (2 * 2 - 1 + 3) * base::kRadiansPerDegree, 1e-12);
}

TEST(LineEffects, FramesAreLostAndRepeatedAsOftenAsSaid) {
  EffectSet set;
  set.add(effect_with("dropped_frames", {0, 0.25, 0, 0}));
  set.add(effect_with("repeated_frames", {0, 0, 0.1, 0}));
  set.reseed(3);
  constexpr int kFrames = 20000;
  int lost = 0, twice = 0;
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_EQ(set.line(Instrument::compass, i).copies, 1);
    lost += set.line(Instrument::imu, i).copies == 0 ? 1 : 0;
    twice += set.line(Instrument::gps, i).copies == 2 ? 1 : 0;
  }
  // Five standard deviations.
  EXPECT_NEAR(lost, 0.25 * kFrames, 5 * std::sqrt(0.25 * 0.75 * kFrames));
  EXPECT_NEAR(twice, 0.1 * kFrames, 5 * std::sqrt(0.1 * 0.9 * kFrames));
}

TEST(LineEffects, JitterIsLateByItsMeanAndNeverEarly) {
  EffectSet set;
  set.add(effect_with("arrival_jitter", {0.01}));
  double sum = 0;
  constexpr int kFrames = 10000;
  for (int i = 0; i < kFrames; ++i) {
    const double late_s = set.line(Instrument::compass, i).late_s;
    ASSERT_GE(late_s, 0);
    sum += late_s;
  }
  EXPECT_NEAR(sum / kFrames, 0.01, 5 * 0.01 / std::sqrt(kFrames));
}

TEST(LineEffects, StallsLastAsLongAsSaidAndComeAsOften) {
  EffectSet set;
  set.add(effect_with("stalls", {0.5, 6}));
  set.reseed(5);
  int stalls = 0;
  double until_s = 0;
  constexpr double kMinutes = 200;
  for (double t_s = 0; t_s < kMinutes * 60; t_s += 0.05) {
    const double held_s = set.line(Instrument::imu, t_s).held_until_s;
    if (held_s <= t_s || held_s == until_s) continue;
    EXPECT_GT(held_s - t_s, 0.4) << "noticed at the first frame within";
    until_s = held_s;
    ++stalls;
  }
  const double expected = kMinutes * 60 / (10 + 0.5);
  EXPECT_NEAR(stalls, expected, 5 * std::sqrt(expected));
}

TEST(LineEffects, WalkGrowsWithTheRootOfTime) {
  constexpr int kWalks = 400;
  constexpr double kTime_s = 25, kStep_s = 0.25;
  double square = 0;
  const State state;
  for (int walk = 0; walk < kWalks; ++walk) {
    EffectSet set;
    set.add(effect_with("gyro_random_walk", {0.1}));
    set.reseed(static_cast<std::uint64_t>(walk) + 1);
    GyroRates rates{};
    for (double t_s = 0; t_s <= kTime_s; t_s += kStep_s) {
      rates = {};
      set.gyros({t_s, state, 15}, rates);
    }
    square += rates[0] * rates[0] / (base::kRadiansPerDegree * base::kRadiansPerDegree);
    EXPECT_EQ(rates[1], 0);
  }
  // Chi-square of so many degrees of freedom, five standard deviations.
  const double expected = 0.1 * 0.1 * kTime_s;
  EXPECT_NEAR(square / kWalks, expected, 5 * expected * std::sqrt(2.0 / kWalks));
}

}  // namespace
}  // namespace navcal::sim::testing
