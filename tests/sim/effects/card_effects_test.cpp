// SPDX-License-Identifier: Apache-2.0
// The inertial card's and the receiver's effects against their equations (docs/simulator.md) on a simple state.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "protocols/imu_card.h"
#include "sim/effects/effect_set.h"
#include "sim/instruments/imu_card.h"
#include "tests/sim/drive.h"
#include "tests/sim/effects/at_rest.h"

namespace navcal::sim::testing {
namespace {

constexpr GyroRates kTrue{0.02, 0.4, -0.03, 0.4};  // of some_state(): A-x, A-z, B-y, B-z

GyroRates added(std::string_view name, std::initializer_list<double> values, double time_s = 0,
                double electronics_C = 15) {
  const auto effect = effect_with(name, values);
  const State state = some_state();
  GyroRates rates{};
  effect->gyros({time_s, state, electronics_C}, rates);
  return rates;
}

void expect_near(const GyroRates& a, const GyroRates& b) {
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a[i], b[i], 1e-12) << i;
}

TEST(CardEffects, Gyros) {
  expect_near(added("gyro_scale", {0.1, 0.2, 0.3, 0.4}),
              {0.1 * kTrue[0], 0.2 * kTrue[1], 0.3 * kTrue[2], 0.4 * kTrue[3]});
  expect_near(added("gyro_temperature", {1, 2, 3, 4}, 0, 18),
              {3 * base::kRadiansPerDegree, 6 * base::kRadiansPerDegree, 9 * base::kRadiansPerDegree,
               12 * base::kRadiansPerDegree});
  expect_near(added("gyro_drift", {0.1, 0.2, 0.3, 0.4}, 50),
              {5 * base::kRadiansPerDegree, 10 * base::kRadiansPerDegree, 15 * base::kRadiansPerDegree,
               20 * base::kRadiansPerDegree});
  expect_near(added("gyro_nonlinearity", {0.001, 0.001, 0.001, 0}),
              {0.001 / base::kRadiansPerDegree * 0.02 * 0.02, 0.001 / base::kRadiansPerDegree * 0.4 * 0.4,
               -0.001 / base::kRadiansPerDegree * 0.03 * 0.03, 0});
}

TEST(CardEffects, GravityAndCrossAxesInTheOrderOfTheirNames) {
  // ax_x ax_y ax_z az_x az_y az_z by_x ...
  const auto g = added("gyro_g_sensitivity", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2});
  const double scale = base::kRadiansPerDegree / kGravity_m_s2;
  expect_near(g, {2.1 * scale, 0.6 * scale, -9.5 * scale, -19 * scale});
  // ax_from_y ax_from_z az_from_x az_from_y by_from_x by_from_z bz_from_x bz_from_y
  const auto cross = added("gyro_cross_axis", {0.1, 0.01, 0.1, 0.01, 0.1, 0.01, 0.1, 0.01});
  const double p = 0.02, q = -0.03, r = 0.4;
  expect_near(cross, {0.1 * q + 0.01 * r, 0.1 * p + 0.01 * q, 0.1 * p + 0.01 * r, 0.1 * p + 0.01 * q});
}

TEST(CardEffects, AccelerometersDepthAndVoltages) {
  const State state = some_state();
  const Instant now{0, state, 19};
  Vector3 force = state.specific_force_m_s2;
  effect_with("accel_bias", {0.1, 0.2, 0.3})->accelerometers(now, force);
  effect_with("accel_scale", {0.1, 0.2, 0.3})->accelerometers(now, force);
  effect_with("accel_vibration", {1, 2, 3})->accelerometers(now, force);
  const double i2 = 1.4 * 1.4;
  EXPECT_NEAR(force[0], 2.1 * 1.1 + 0.1 + i2, 1e-12);
  EXPECT_NEAR(force[1], 0.6 * 1.2 + 0.2 + 2 * i2, 1e-12);
  EXPECT_NEAR(force[2], -9.5 * 1.3 + 0.3 + 3 * i2, 1e-12);
  double depth = 2;
  effect_with("depth_scale", {0.05})->depth(now, depth);
  effect_with("depth_temperature", {0.1})->depth(now, depth);
  EXPECT_NEAR(depth, 2 * 1.05 + 0.1 * 4, 1e-12);
  CardVoltages_mV voltages;
  voltages.fill(1000);
  effect_with("adc_droop", {0.01})->card_voltages(now, voltages);
  for (const double voltage : voltages) EXPECT_NEAR(voltage, 1014, 1e-9);
}

TEST(CardEffects, LatencyMakesTheCardSayWhatWasEarlier) {
  struct Sinking final : Motion {
    [[nodiscard]] State at(std::int64_t t_ns) const override {
      State state;
      state.specific_force_m_s2 = {0, 0, -kGravity_m_s2};
      state.position_m[2] = static_cast<double>(t_ns - kStart_ns) * 1e-9;
      return state;
    }
  } const motion;
  EffectSet effects(kStart_ns);
  effects.add(effect_with("imu_latency", {0.1}), {5, 100});
  ImuCard::Options options;
  options.rate_noise_deg_s = options.turn_on_bias_deg_s = options.force_noise_m_s2 = options.depth_noise_m = 0;
  options.effects = &effects;
  ImuCard card(options, motion);
  card.power_on(kStart_ns);
  for (const auto& frame : run_to(card, kStart_ns + 10 * kSecond_ns)) {
    const double sent_s = static_cast<double>(frame.start_ns - kStart_ns) * 1e-9;
    const double depth_m = (protocols::imu_card::decode_record(frame.bytes)->raw[7] / 16.0 - 250) / 187.5;
    EXPECT_NEAR(sent_s - depth_m, sent_s < 5 ? 0.025 : 0.125, 2e-4) << sent_s;
  }
}

TEST(ReceiverEffects, LeverArmTurnsWithTheVehicle) {
  State state = some_state();
  state.euler_rad = {0, 0, std::numbers::pi / 2};
  state.rate_rad_s = {0, 0, 0.5};
  AntennaMotion antenna{{10, 20, 0}, {1, 0, 0}};
  effect_with("gps_lever_arm", {2, 0})->antenna({0, state, 15}, antenna);
  EXPECT_NEAR(antenna.position_m[0], 10, 1e-12);
  EXPECT_NEAR(antenna.position_m[1], 22, 1e-12);
  EXPECT_NEAR(antenna.velocity_m_s[0], 1 - 0.5 * 2, 1e-12) << "w x l is to starboard: south when heading east";
  EXPECT_NEAR(antenna.velocity_m_s[1], 0, 1e-12);
  Delays late;
  effect_with("gps_latency", {0.7})->delays(late);
  EXPECT_EQ(late.gps_s, 0.7);
  EXPECT_EQ(late.card_s, 0);
}

}  // namespace
}  // namespace navcal::sim::testing
