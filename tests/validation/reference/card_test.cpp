// SPDX-License-Identifier: Apache-2.0
// Each departure of the inertial card against its equation, channel by channel, without noise.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/validation/reference/bench.h"

namespace navcal::reference::testing {
namespace {

constexpr double kCardDuration_s = 40;
constexpr double kRateStep_rad_s = kDegree / 160, kForceStep_m_s2 = kGravity_m_s2 / 16000,
                 kDepthStep_m = 1.0 / 3000;

double resolution(std::size_t channel) {
  return channel < 4 ? kRateStep_rad_s : channel < 7 ? kForceStep_m_s2 : kDepthStep_m;
}

const World& card_world() {
  static const World swung_about = swung(kCardDuration_s);
  return swung_about;
}

/// What a channel should read of the vehicle's state.
double nominal(const Snapshot& s, std::size_t channel) {
  if (channel < 4) return s.rate_rad_s(kGyroAxes[channel]);
  const Vector3 force = s.acceleration_m_s2 - kGravity_m_s2 * s.down();
  return channel < 7 ? force(static_cast<int>(channel) - 4) : s.position_m.z();
}

using Equation = std::function<double(const Snapshot&, double nominal)>;

/// One channel reads what the equation makes of the nominal one; the others listed stay as they are.
void expect_reads(const ParameterDeviations& deviations, std::size_t channel, const Equation& equation) {
  const auto samples = card_along(card_world(), deviations.card);
  ASSERT_GT(samples.size(), 700U);
  double largest = 0;
  for (const CardSample& sample : samples) {
    const Snapshot s = card_world().at(sample.time_s);
    for (std::size_t i = 0; i < 8; ++i) {
      const double expected = i == channel ? equation(s, nominal(s, i)) : nominal(s, i);
      ASSERT_NEAR(sample.values[i], expected, 0.51 * resolution(i)) << "channel " << i << " at " << sample.time_s;
    }
    largest = std::max(largest, std::abs(equation(s, nominal(s, channel)) - nominal(s, channel)));
  }
  EXPECT_GT(largest, 3 * resolution(channel)) << "nothing was seen of it";
}

TEST(Card, NominallyReadsWhatIsSo) {
  for (const CardSample& sample : card_along(card_world(), {})) {
    const Snapshot s = card_world().at(sample.time_s);
    for (std::size_t i = 0; i < 8; ++i) ASSERT_NEAR(sample.values[i], nominal(s, i), 0.51 * resolution(i)) << i;
  }
}

TEST(Card, GyroScale) {
  expect_reads(with("gyro_scale", {{"scale_az", 0.03}}), 1, [](const Snapshot&, double w) { return 1.03 * w; });
}

TEST(Card, GyroTemperature) {
  expect_reads(with("gyro_temperature", {{"deg_per_s_per_C_by", 0.06}}), 2,
               [](const Snapshot& s, double w) { return w + 0.06 * kDegree * (s.electronics_C - 15); });
}

TEST(Card, GyroDrift) {
  expect_reads(with("gyro_drift", {{"deg_per_s2_bz", 0.01}}), 3,
               [](const Snapshot& s, double w) { return w + 0.01 * kDegree * s.time_s; });
}

TEST(Card, GyroFeelsForce) {
  expect_reads(with("gyro_g_sensitivity", {{"ax_x_deg_per_s_per_g", 0.6}, {"ax_z_deg_per_s_per_g", -0.3}}), 0,
               [](const Snapshot& s, double w) {
                 return w + kDegree / kGravity_m_s2 * (0.6 * nominal(s, 4) - 0.3 * nominal(s, 6));
               });
}

TEST(Card, GyroCrossAxis) {
  expect_reads(with("gyro_cross_axis", {{"by_from_x", 0.03}, {"by_from_z", -0.02}}), 2,
               [](const Snapshot& s, double w) { return w + 0.03 * s.rate_rad_s.x() - 0.02 * s.rate_rad_s.z(); });
  expect_reads(with("gyro_cross_axis", {{"ax_from_z", 0.03}, {"ax_from_y", 0.01}}), 0,
               [](const Snapshot& s, double w) { return w + 0.03 * s.rate_rad_s.z() + 0.01 * s.rate_rad_s.y(); });
  expect_reads(with("gyro_cross_axis", {{"bz_from_y", 0.03}}), 3,
               [](const Snapshot& s, double w) { return w + 0.03 * s.rate_rad_s.y(); });
}

TEST(Card, GyroNonlinearity) {
  expect_reads(with("gyro_nonlinearity", {{"s_per_deg_az", 0.0008}}), 1, [](const Snapshot&, double w) {
    return w + 0.0008 * (w / kDegree) * std::abs(w / kDegree) * kDegree;
  });
}

TEST(Card, ForceBiasScaleAndVibration) {
  expect_reads(with("accel_bias", {{"y_m_s2", 0.12}}), 5, [](const Snapshot&, double f) { return f + 0.12; });
  expect_reads(with("accel_scale", {{"z", 0.02}}), 6, [](const Snapshot&, double f) { return 1.02 * f; });
  expect_reads(with("accel_vibration", {{"x_m_s2_per_A2", 0.05}}), 4,
               [](const Snapshot& s, double f) { return f + 0.05 * s.motor_current_A * s.motor_current_A; });
}

TEST(Card, DepthScaleAndTemperature) {
  expect_reads(with("depth_scale", {{"scale", 0.06}}), 7, [](const Snapshot&, double z) { return 1.06 * z; });
  expect_reads(with("depth_temperature", {{"m_per_C", 0.025}}), 7,
               [](const Snapshot& s, double z) { return z + 0.025 * (s.electronics_C - 15); });
}

TEST(Card, DroopTakesEveryChannelInMillivolts) {
  const ParameterDeviations deviations = with("adc_droop", {{"per_A", 0.0015}});
  for (const CardSample& sample : card_along(card_world(), deviations.card)) {
    const Snapshot s = card_world().at(sample.time_s);
    const double factor = 1 + 0.0015 * s.motor_current_A;
    ASSERT_NEAR(sample.values[1], nominal(s, 1) * factor + 204.8 * kDegree * (factor - 1), 0.51 * kRateStep_rad_s);
    ASSERT_NEAR(sample.values[4], nominal(s, 4) * factor + 2.048 * kGravity_m_s2 * (factor - 1),
                0.51 * kForceStep_m_s2);
    ASSERT_NEAR(sample.values[7], nominal(s, 7) * factor + 250 / 187.5 * (factor - 1), 0.51 * kDepthStep_m);
  }
}

TEST(Card, LatencyIsAPureDelayOfEveryChannel) {
  for (const CardSample& sample : card_along(card_world(), with("imu_latency", {{"tau_s", 0.05}}).card)) {
    const Snapshot s = card_world().at(sample.time_s - 0.05);
    for (std::size_t i = 0; i < 8; ++i) ASSERT_NEAR(sample.values[i], nominal(s, i), 0.51 * resolution(i)) << i;
  }
}

TEST(Card, ThermalTwistTurnsTheTriadWithTheSquareOfTheTemperature) {
  const ParameterDeviations deviations = with("gyro_thermal_twist", {{"y_deg_per_C2", 1.0}});
  for (const CardSample& sample : card_along(card_world(), deviations.card)) {
    const Snapshot s = card_world().at(sample.time_s);
    const double angle = kDegree * (s.electronics_C - 15) * (s.electronics_C - 15);
    // y x w = (w_z, 0, -w_x)
    ASSERT_NEAR(sample.values[0], s.rate_rad_s.x() - angle * s.rate_rad_s.z(), 0.51 * kRateStep_rad_s);
    ASSERT_NEAR(sample.values[1], s.rate_rad_s.z() + angle * s.rate_rad_s.x(), 0.51 * kRateStep_rad_s);
  }
}

TEST(Card, DepthHysteresisStaysWithinItsPlayAndLagsBehindEveryReversal) {
  const double half_m = 0.15;
  double least = 1, greatest = -1;
  const auto samples = card_along(card_world(), with("depth_hysteresis", {{"width_m", 2 * half_m}}).card);
  for (const CardSample& sample : samples) {
    const double off_m = sample.values[7] - nominal(card_world().at(sample.time_s), 7);
    ASSERT_LT(std::abs(off_m), half_m + kDepthStep_m);
    least = std::min(least, off_m);
    greatest = std::max(greatest, off_m);
  }
  EXPECT_NEAR(least, -half_m, 0.01);    // it went down
  EXPECT_NEAR(greatest, half_m, 0.01);  // and up
}

TEST(Card, PopcornStandsAtOneOfTwoLevels) {
  int jumps = 0;
  double last = 0;
  for (const CardSample& sample : card_along(card_world(), with("gyro_popcorn", {{"deg_per_s", 0.4}}).card)) {
    const double level = (sample.values[1] - nominal(card_world().at(sample.time_s), 1)) / (0.4 * kDegree);
    ASSERT_NEAR(level, level > 0.5 ? 1 : 0, 0.51 * kRateStep_rad_s / (0.4 * kDegree));
    if (std::round(level) != last) ++jumps;
    last = std::round(level);
  }
  EXPECT_LE(jumps, 8);
}

TEST(Card, NoiseIsOfTheStatedSize) {
  Fitting fitting = exact();
  fitting.noisy = true;
  std::array<double, 8> sum{}, squares{};
  const auto samples = card_along(card_world(), {}, fitting);
  for (const CardSample& sample : samples) {
    const Snapshot s = card_world().at(sample.time_s);
    for (std::size_t i = 0; i < 8; ++i) {
      sum[i] += sample.values[i] - nominal(s, i);
      squares[i] += std::pow(sample.values[i] - nominal(s, i), 2);
    }
  }
  const auto n = static_cast<double>(samples.size());
  for (std::size_t i = 0; i < 8; ++i) {
    const double sigma = i < 4 ? 0.1 * kDegree : 0.02;
    const double variance = squares[i] / n - sum[i] * sum[i] / (n * n);
    // Chi-square with n degrees of freedom, five standard deviations.
    EXPECT_NEAR(variance / (sigma * sigma), 1, 5 * std::sqrt(2 / n) + 0.005) << "channel " << i;
    EXPECT_LT(std::abs(sum[i] / n), i < 4 ? 5 * 0.3 * kDegree : 5 * sigma / std::sqrt(n)) << "channel " << i;
  }
}

}  // namespace
}  // namespace navcal::reference::testing
