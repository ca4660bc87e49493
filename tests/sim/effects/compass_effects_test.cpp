// SPDX-License-Identifier: Apache-2.0
// The compass's effects against their equations (docs/simulator.md) on a simple state.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "sim/effects/effect_set.h"
#include "sim/instruments/tcm2_sensor.h"
#include "tests/sim/drive.h"
#include "tests/sim/effects/at_rest.h"

namespace navcal::sim::testing {
namespace {

constexpr Vector3 kField{12, -7, 43};

Vector3 field_with(std::string_view name, std::initializer_list<double> values, double electronics_C = 15) {
  const auto effect = effect_with(name, values);
  const State state = some_state();
  Vector3 field = kField;
  effect->body_field({0, state, electronics_C}, field);
  return field;
}

void expect_near(const Vector3& a, const Vector3& b, double tolerance = 1e-9) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(CompassEffects, Additions) {
  expect_near(field_with("hard_iron", {1, 2, 3}), {13, -5, 46});
  expect_near(field_with("motor_field", {1, 2, 3}), {12 + 1.4, -7 + 2.8, 43 + 4.2});
  expect_near(field_with("mag_temperature", {1, 2, 3}, 17), {14, -3, 49});
  expect_near(field_with("mag_temperature", {1, 2, 3}, 15), kField);
}

TEST(CompassEffects, SoftIronIsSymmetric) {
  expect_near(
      field_with("soft_iron", {0.1, 0.2, 0.3, 0.01, 0.02, 0.03}),
      {12 * 1.1 - 7 * 0.01 + 43 * 0.02, -7 * 1.2 + 12 * 0.01 + 43 * 0.03, 43 * 1.3 + 12 * 0.02 - 7 * 0.03});
}

TEST(CompassEffects, MisalignmentTurnsAndKeepsTheSize) {
  const double a = 0.01;
  const Vector3 field = field_with("compass_misalignment", {0, 0, a / base::kRadiansPerDegree});
  // (1 - [a]x) m to first order: m - a x m.
  expect_near(field, {12 + a * -7, -7 - a * 12, 43}, 43 * a * a);
  const Vector3 large = field_with("compass_misalignment", {20, -30, 10});
  EXPECT_NEAR(std::hypot(large[0], large[1], large[2]), std::hypot(12, -7, 43), 1e-9);
}

TEST(CompassEffects, DeclinationTurnsTheEarthsFieldToTheEast) {
  const auto effect = effect_with("declination", {90});
  const State state = some_state();
  Vector3 field{19, 0, 44};
  effect->earth_field({0, state, 15}, field);
  expect_near(field, {0, 19, 44});
}

TEST(CompassEffects, HysteresisRemembersAMinuteAndBeginsSettled) {
  const auto effect = effect_with("magnetic_hysteresis", {0.1});
  const State state = some_state();
  Vector3 field{10, 0, 0};
  effect->body_field({0, state, 15}, field);
  EXPECT_NEAR(field[0], 11, 1e-9);
  for (int i = 1; i <= 600; ++i) {
    field = {-10, 0, 0};
    effect->body_field({0.1 * i, state, 15}, field);
  }
  // After one time constant: 10 (2/e - 1), but for the tenth of a second in which the field turned.
  EXPECT_NEAR(field[0], -10 + 0.1 * 10 * (2 / std::numbers::e - 1), 1e-3);
}

TEST(CompassEffects, LagFollowsARampItsTimeConstantBehind) {
  for (const double step_s : {0.01, 0.1}) {
    const auto effect = effect_with("compass_lag", {0.2});
    const State state = some_state();
    Vector3 field{};
    for (int i = 0; i * step_s < 4; ++i) {
      field = {5 * i * step_s, 0, 1};
      effect->body_field({i * step_s, state, 15}, field);
      if (i * step_s > 3) {
        EXPECT_NEAR(field[0], 5 * (i * step_s - 0.2), 1e-6) << step_s;
      }
    }
    EXPECT_NEAR(field[2], 1, 1e-12);
  }
}

TEST(CompassEffects, OrderIsSoftIronThenTurnThenAdditionThenLag) {
  const State state = some_state();
  EffectSet set;
  set.add(effect_with("compass_lag", {1}));
  set.add(effect_with("hard_iron", {0, 10, 0}));
  set.add(effect_with("compass_misalignment", {0, 0, 90}));
  set.add(effect_with("soft_iron", {1}));
  Vector3 field{5, 0, 0};
  set.body_field({0, state, 15}, field);
  // Doubled along x; then a triad turned by 90 degrees to starboard sees it to port; then iron; settled at once.
  expect_near(field, {0, 0, 0});
}

TEST(CompassEffects, SloshSeesTheAccelerationAndOffsetsTheTilt) {
  State state = some_state();
  state.euler_rad = {0, 0, 0};
  state.specific_force_m_s2 = {0.5, 0.8, -kGravity_m_s2};  // u' = 0.5, u r = 0.8
  const Instant now{0, state, 15};
  Tilt tilt;
  effect_with("tilt_slosh", {0.3})->tilt_seen(now, tilt);
  EXPECT_NEAR(tilt.roll_rad, -0.3 * 0.8 / kGravity_m_s2, 1e-12);
  EXPECT_NEAR(tilt.pitch_rad, 0.3 * 0.5 / kGravity_m_s2, 1e-12);
  state.euler_rad = {0.3, -0.2, 1};
  state.specific_force_m_s2 =
      transpose(R_world_from_body(state.euler_rad)) * Vector3{0, 0, -kGravity_m_s2};  // at rest, tilted
  Tilt rest;
  effect_with("tilt_slosh", {1})->tilt_seen(now, rest);
  EXPECT_NEAR(rest.roll_rad, 0, 1e-12);
  EXPECT_NEAR(rest.pitch_rad, 0, 1e-12);
  Tilt said{0.1, 0.2};
  effect_with("tilt_offset", {1, -2})->tilt_said(now, said);
  EXPECT_NEAR(said.roll_rad, 0.1 + base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(said.pitch_rad, 0.2 - 2 * base::kRadiansPerDegree, 1e-12);
}

TEST(CompassEffects, TheSensorSaysTheHeadingOfItsOwnFieldAndTilt) {
  Still motion;
  motion.state.field_world_uT = {20, 0, 40};
  EffectSet effects(kStart_ns);
  effects.add(effect_with("hard_iron", {0, -20, 0}), {10, 20});
  effects.add(effect_with("declination", {30}), {30, 40});
  Tcm2Sensor::Options options;
  options.field_noise_uT = options.tilt_noise_deg = 0;
  options.effects = &effects;
  Tcm2Sensor sensor(options, motion, 1);
  sensor.power_on(kStart_ns);
  EXPECT_NEAR(sensor.measure(kStart_ns + 5 * kSecond_ns).heading_rad, 0, 1e-9);
  EXPECT_NEAR(sensor.measure(kStart_ns + 15 * kSecond_ns).heading_rad, 45 * base::kRadiansPerDegree, 1e-9);
  EXPECT_NEAR(sensor.measure(kStart_ns + 25 * kSecond_ns).heading_rad, 0, 1e-9);
  EXPECT_NEAR(sensor.measure(kStart_ns + 35 * kSecond_ns).heading_rad, 330 * base::kRadiansPerDegree, 1e-9);
}

}  // namespace
}  // namespace navcal::sim::testing
