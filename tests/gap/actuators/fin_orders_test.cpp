// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/fin_orders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/angles.h"

namespace navcal::gap {
namespace {

constexpr double kFinLag_s = 0.15, kReport_rad = 0.00182, kDuration_s = 120, kStep_s = 0.01;
constexpr std::size_t kFinRows = 12'000;

/// A helmsman who tells the servos something ten times a second, and what the card reports of it.
struct Steered {
  std::vector<MotorReading> readings;
  std::vector<Vector3> servos_rad;  ///< every hundredth of a second
  std::vector<Vector3> told_rad;    ///< every tenth of a second
};

Steered steered(double restless_deg) {
  std::mt19937_64 dice(7);
  std::normal_distribution<double> normal;
  Steered result;
  Vector3 command{}, servo{};
  for (int k = 0; k * kStep_s <= kDuration_s; ++k) {
    const double t = k * kStep_s;
    for (std::size_t i = 0; i < 3; ++i) {
      servo[i] = command[i] + (servo[i] - command[i]) * std::exp(-kStep_s / kFinLag_s);
    }
    if (k % 10 == 0) {
      const double rudder = (5 * std::sin(0.4 * t) + restless_deg * normal(dice)) * base::kRadiansPerDegree;
      const double elevator = restless_deg * normal(dice) * base::kRadiansPerDegree,
                   side = std::sqrt(0.75) * elevator;
      command = {-rudder, rudder / 2 + side, rudder / 2 - side};
      for (double& angle : command)
        angle = std::round(angle / base::kRadiansPerDegree * 10) / 10 * base::kRadiansPerDegree;
      result.told_rad.push_back(command);
    }
    result.servos_rad.push_back(servo);
    if (k % 10 != 4) continue;
    MotorReading reading{t, 780, servo, 1.4};
    for (double& angle : reading.fins_rad) {
      angle =
          std::round((angle / base::kRadiansPerDegree + 0.1 * normal(dice)) * 10) / 10 * base::kRadiansPerDegree;
    }
    result.readings.push_back(reading);
  }
  return result;
}

FinOrders orders_of(const Steered& helm) {
  return {helm.readings, regular_orders(0, kDuration_s), {}, kFinLag_s, kReport_rad};
}

/// Root mean square of what moves within a tenth of a second beyond the second around it, degrees.
double restlessness(const std::vector<Vector3>& path, std::size_t fin) {
  double square = 0;
  int count = 0;
  for (std::size_t k = 200; k + 200 < path.size() && k < 11'500; ++k, ++count) {
    const double bend = path[k][fin] - (path[k - 10][fin] + path[k + 10][fin]) / 2;
    square += bend * bend;
  }
  return std::sqrt(square / count) / base::kRadiansPerDegree;
}

double rms_apart_deg(const std::vector<Vector3>& a, const std::vector<Vector3>& b, std::size_t fin) {
  double square = 0;
  for (std::size_t k = 200; k < 11'500; ++k) square += std::pow(a[k][fin] - b[k][fin], 2);
  return std::sqrt(square / 11'300) / base::kRadiansPerDegree;
}

TEST(FinOrders, TheServosAreWhereTheyWereToTheReportsNoiseOrBetter) {
  for (const double restless_deg : {0.0, 0.6}) {
    const Steered helm = steered(restless_deg);
    const auto servos = orders_of(helm).servos_rad(kFinRows, kStep_s);
    for (const std::size_t fin : {0U, 1U, 2U}) {
      const double most_deg = restless_deg == 0 ? 0.05 : 0.11;  // orders that are noise are hardly foreseen
      EXPECT_LT(rms_apart_deg(servos, helm.servos_rad, fin), most_deg) << fin << " restless by " << restless_deg;
    }
  }
}

// Orders that are noise look smaller than they are to reports that come as seldom.
TEST(FinOrders, DrawsOfARestlessHelmAreRestless) {
  const Steered helm = steered(0.6);
  const FinOrders orders = orders_of(helm);
  for (const double later_s : {0.0, 0.03, 0.08}) {
    sim::Noise noise(2);
    const auto path = orders.drawn_servos_rad(kFinRows, kStep_s, later_s, noise);
    for (const std::size_t fin : {0U, 1U, 2U}) {
      const double of_theirs = restlessness(path, fin) / restlessness(helm.servos_rad, fin);
      EXPECT_GT(of_theirs, 0.5) << fin << " later by " << later_s;
      EXPECT_LT(of_theirs, 1.2) << fin << " later by " << later_s;
    }
  }
}

double rolling_deg(const Vector3& fins) { return (fins[0] + fins[1] + fins[2]) / 3 / base::kRadiansPerDegree; }

double rolling_rms_deg(const std::vector<Vector3>& path) {
  double square = 0;
  for (std::size_t k = 200; k < 11'500; ++k) square += std::pow(rolling_deg(path[k]), 2);
  return std::sqrt(square / 11'300);
}

// Nulls that were rolled by the noise of the recorded reports had twice the roll of the vehicle that they stood
// for.
TEST(FinOrders, DrawsRollTheVehicleByWhatTenthsRoundOffAndNotByTheReportsNoise) {
  const Steered helm = steered(0.6);
  sim::Noise noise(2);
  const auto path = orders_of(helm).drawn_servos_rad(kFinRows, kStep_s, 0, noise);
  EXPECT_GT(rolling_rms_deg(path), 0.005);
  EXPECT_LT(rolling_rms_deg(path), 0.02);
}

TEST(FinOrders, FinsThatRollTheVehicleOnPurposeDo) {
  Steered helm = steered(0);
  for (MotorReading& reading : helm.readings) {
    for (double& angle : reading.fins_rad) angle += 2 * base::kRadiansPerDegree;
  }
  const auto path = orders_of(helm).servos_rad(kFinRows, kStep_s);
  for (std::size_t k = 200; k < 11'500; ++k) EXPECT_NEAR(rolling_deg(path[k]), 2, 0.15);
}

TEST(FinOrders, OrdersThatTheFinsDidNotObeyAreKnownByWhatTheyLeave) {
  const Steered helm = steered(0.6);
  EXPECT_LT(orders_of(helm).misfit(), 1.1);
  EXPECT_GT(orders_of(helm).misfit(), 0.3);
  const FinOrders few(helm.readings, std::vector{20.0, 50.0}, {}, kFinLag_s, kReport_rad);
  EXPECT_GT(few.misfit(), 10);
}

TEST(FinOrders, RecordedCommandsPutTheServosNearerToWhereTheyWere) {
  const Steered helm = steered(0.6);
  const auto orders_s = regular_orders(0, kDuration_s);
  const FinOrders recorded(helm.readings, orders_s, std::span(helm.told_rad).first(orders_s.size()), kFinLag_s,
                           kReport_rad);
  EXPECT_TRUE(recorded.obeys());
  EXPECT_FALSE(orders_of(helm).obeys());
  EXPECT_LT(recorded.misfit(), 1.2);
  sim::Noise noise(2);
  const auto servos = recorded.servos_rad(kFinRows, kStep_s),
             estimated = orders_of(helm).servos_rad(kFinRows, kStep_s),
             drawn = recorded.drawn_servos_rad(kFinRows, kStep_s, 0, noise);
  for (const std::size_t fin : {0U, 1U, 2U}) {
    const double apart_deg = rms_apart_deg(servos, helm.servos_rad, fin);
    EXPECT_LT(apart_deg, 0.3 * rms_apart_deg(estimated, helm.servos_rad, fin)) << fin;
    EXPECT_LT(rms_apart_deg(drawn, helm.servos_rad, fin), 0.03) << fin;
  }
}

TEST(FinOrders, GoOnWhereThereAreNoReports) {
  Steered helm = steered(0.6);
  std::erase_if(helm.readings, [](const MotorReading& r) { return r.time_s > 40 && r.time_s < 60; });
  const auto path = orders_of(helm).servos_rad(kFinRows, kStep_s);
  ASSERT_EQ(path.size(), kFinRows);
  for (std::size_t k = 4100; k < 5900; ++k) EXPECT_LT(std::abs(path[k][0]), 8 * base::kRadiansPerDegree);
  for (std::size_t k = 6200; k < 11'500; ++k)
    EXPECT_NEAR(path[k][0], helm.servos_rad[k][0], 0.5 * base::kRadiansPerDegree);
}

}  // namespace
}  // namespace navcal::gap
