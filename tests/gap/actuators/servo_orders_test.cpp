// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/servo_orders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/angles.h"

namespace navcal::gap {
namespace {

constexpr double kServoLag_s = 0.15, kNoise_rad = 0.1 * base::kRadiansPerDegree;

/// A servo under orders that come ten a second, and noisy reports of it.
struct Told {
  std::vector<double> order_times_s, report_times_s, reports_rad;
  std::vector<double> commands_rad;  ///< from each order on
};

Told told(double phase_s, double duration_s, const std::function<double(int)>& command_rad,
          std::uint64_t seed = 1) {
  sim::Noise noise(seed);
  Told told;
  double servo = 0, command = 0, at_s = 0;
  const auto go_on_until = [&](double time_s) {
    servo = command + (servo - command) * std::exp(-(time_s - at_s) / kServoLag_s);
    at_s = time_s;
  };
  for (int k = 0; k * 0.1 + 0.05 < duration_s; ++k) {
    const double report_s = 0.1 * k + 0.001, order_s = report_s + phase_s;
    go_on_until(report_s);
    told.report_times_s.push_back(report_s);
    told.reports_rad.push_back(servo + noise.normal(kNoise_rad));
    go_on_until(order_s);
    command = command_rad(k);
    told.order_times_s.push_back(order_s);
    told.commands_rad.push_back(command);
  }
  return told;
}

/// Commands after each order that a smoother knows.
std::vector<double> commands(const ServoOrders& orders) {
  std::vector<double> result;
  double command = orders.command_rad;
  for (const double step : orders.steps_rad) result.push_back(command += step);
  return result;
}

double rms_apart(const std::vector<double>& a, const std::vector<double>& b, std::size_t from, std::size_t until) {
  double square = 0;
  for (std::size_t i = from; i < until; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square / static_cast<double>(until - from));
}

class AtPhase : public testing::TestWithParam<double> {};

TEST_P(AtPhase, LongStepsAreSharpAndACommandThatStandsIsQuiet) {
  const Told servo =
      told(GetParam(), 60, [](int k) { return (k / 100 % 2 == 0 ? 5 : -9) * base::kRadiansPerDegree; });
  ServoSmoother smoother(servo.report_times_s, servo.order_times_s, kServoLag_s);
  const auto found = commands(smoother.smoothed(servo.reports_rad, kNoise_rad));
  ASSERT_EQ(found.size(), servo.commands_rad.size() - 1);  // nothing is reported after the last one
  for (std::size_t i = 5; i + 5 < found.size(); ++i) {
    EXPECT_NEAR(found[i], servo.commands_rad[i],
                (i % 100 < 2 || i % 100 > 97 ? 1.0 : 0.25) * base::kRadiansPerDegree)
        << i;
  }
  EXPECT_LT(rms_apart(found, servo.commands_rad, 210, 290), 0.05 * base::kRadiansPerDegree);
}

TEST_P(AtPhase, ARestlessHelmIsFollowed) {
  sim::Noise helm(3);
  const Told servo = told(GetParam(), 120, [&](int) { return helm.normal(2 * base::kRadiansPerDegree); });
  ServoSmoother smoother(servo.report_times_s, servo.order_times_s, kServoLag_s);
  const auto found = commands(smoother.smoothed(servo.reports_rad, kNoise_rad));
  EXPECT_LT(rms_apart(found, servo.commands_rad, 10, found.size() - 10), 0.6 * base::kRadiansPerDegree);
}

// Nulls are to be as far from the smoothed way as the recorded vehicle is.
TEST_P(AtPhase, DrawsScatterAsTheTruthDoes) {
  sim::Noise helm(4);
  double command = 0;
  const Told servo = told(GetParam(), 300, [&](int) {
    return command += helm.normal(0.5 * base::kRadiansPerDegree) - 0.02 * command;
  });
  ServoSmoother smoother(servo.report_times_s, servo.order_times_s, kServoLag_s);
  const auto found = commands(smoother.smoothed(servo.reports_rad, kNoise_rad));
  sim::Noise noise(5);
  const auto drawn = commands(smoother.drawn(servo.reports_rad, kNoise_rad, noise));
  const double truth = rms_apart(found, servo.commands_rad, 10, found.size() - 10);
  const double draw = rms_apart(found, drawn, 10, found.size() - 10);
  EXPECT_NEAR(draw / truth, 1, 0.25);
}

INSTANTIATE_TEST_SUITE_P(AfterAReport, AtPhase, testing::Values(0.005, 0.02, 0.08, 0.095));

TEST(ServoOrders, AServoThatIsToldNothingStandsAtTheMeanOfItsReports) {
  const Told servo = told(0.05, 30, [](int) { return 0; });
  ServoSmoother smoother(servo.report_times_s, {}, kServoLag_s);
  const ServoOrders found = smoother.smoothed(servo.reports_rad, kNoise_rad);
  EXPECT_TRUE(found.steps_rad.empty());
  EXPECT_NEAR(found.command_rad, 0, 0.03 * base::kRadiansPerDegree);
}

TEST(ServoOrders, OneReportIsBelieved) {
  ServoSmoother smoother(std::vector{3.0}, std::vector{1.0, 2.0, 4.0}, kServoLag_s);
  EXPECT_TRUE(smoother.order_times_s().empty());
  const ServoOrders found = smoother.smoothed(std::vector{0.1}, kNoise_rad);
  EXPECT_NEAR(found.angle_rad, 0.1, 1e-12);
  EXPECT_NEAR(found.command_rad, 0.1, 1e-12);
}

TEST(ServoOrders, OrdersAtOneInstantAndReportsFarApartAreNoTrouble) {
  const Told servo = told(0.05, 60, [](int) { return 4 * base::kRadiansPerDegree; });
  std::vector<double> times_s, reports_rad, orders_s;
  for (std::size_t i = 0; i < servo.reports_rad.size(); ++i) {
    if (i > 100 && i < 400) continue;
    times_s.push_back(servo.report_times_s[i]);
    reports_rad.push_back(servo.reports_rad[i]);
  }
  for (const double time_s : servo.order_times_s) orders_s.insert(orders_s.end(), 3, time_s);
  ServoSmoother smoother(times_s, orders_s, kServoLag_s);
  for (const double command : commands(smoother.smoothed(reports_rad, kNoise_rad))) {
    EXPECT_TRUE(std::isfinite(command));
    EXPECT_NEAR(command, 4 * base::kRadiansPerDegree, 4.1 * base::kRadiansPerDegree);
  }
}

/// A helm that moves by ramps: twenty orders a second, of at most ten degrees each, which act up to `late_s`
/// later.
struct Ramps {
  std::vector<double> order_times_s, commands_rad, report_times_s, reports_rad, angles_rad;
};

Ramps ramps(double late_s, double obeys, std::uint64_t seed) {
  sim::Noise noise(seed);
  Ramps ramps;
  double servo = 0, told = 0, command = 0, wanted = 0, acts_s = 0;
  for (int ms = 0; ms < 90'000; ++ms) {
    servo += (command - servo) * -std::expm1(-0.001 / kServoLag_s);
    const double time_s = 0.001 * ms;
    if (ms % 100 == 7) wanted = (ms / 3000 % 2 == 0 ? 14 : -14) * base::kRadiansPerDegree + noise.normal(0.01);
    if (ms % 50 == 7 && told != wanted) {
      told = std::clamp(wanted, told - 10 * base::kRadiansPerDegree, told + 10 * base::kRadiansPerDegree);
      ramps.order_times_s.push_back(time_s);
      ramps.commands_rad.push_back(told);
      acts_s = time_s + noise.uniform(0, late_s);
    }
    if (time_s >= acts_s) command = obeys * told;
    if (ms % 100 != 2) continue;  // the first report is before the first order
    ramps.report_times_s.push_back(time_s);
    ramps.reports_rad.push_back(servo + noise.normal(kNoise_rad));
    ramps.angles_rad.push_back(servo);
  }
  return ramps;
}

class Recorded : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Recorded, CommandsAreTakenAsTheyWereGivenThoughTheyActALittleLate) {
  for (const double late_s : {0.0, 0.008}) {
    const Ramps helm = ramps(late_s, 1, GetParam());
    ServoSmoother smoother(helm.report_times_s, helm.order_times_s, kServoLag_s, helm.commands_rad);
    const ServoOrders found = smoother.smoothed(helm.reports_rad, kNoise_rad);
    EXPECT_TRUE(smoother.obeys()) << late_s;
    const auto told = commands(found);
    for (std::size_t i = 1; i < told.size(); ++i)
      EXPECT_NEAR(told[i] - told[i - 1], helm.commands_rad[i] - helm.commands_rad[i - 1], 1e-9) << i;
    EXPECT_NEAR(told.back(), helm.commands_rad[told.size() - 1], 0.02 * base::kRadiansPerDegree);
  }
}

TEST_P(Recorded, CommandsThatTheServoDoesNotObeyAreNotBelieved) {
  for (const double obeys : {-1.0, 0.0, 0.6}) {
    const Ramps helm = ramps(0, obeys, GetParam());
    ServoSmoother smoother(helm.report_times_s, helm.order_times_s, kServoLag_s, helm.commands_rad);
    (void)smoother.smoothed(helm.reports_rad, kNoise_rad);
    EXPECT_FALSE(smoother.obeys()) << obeys;
  }
}

TEST_P(Recorded, AServoThatStandsOffItsCommandObeysAndItsOffsetIsFound) {
  Ramps helm = ramps(0, 1, GetParam());
  for (double& angle_rad : helm.reports_rad) angle_rad += base::kRadiansPerDegree;
  ServoSmoother smoother(helm.report_times_s, helm.order_times_s, kServoLag_s, helm.commands_rad);
  const auto found = commands(smoother.smoothed(helm.reports_rad, kNoise_rad));
  EXPECT_TRUE(smoother.obeys());
  EXPECT_NEAR(found.back() - helm.commands_rad[found.size() - 1], base::kRadiansPerDegree,
              0.02 * base::kRadiansPerDegree);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Recorded, testing::Values(1, 2, 3));

}  // namespace
}  // namespace navcal::gap
