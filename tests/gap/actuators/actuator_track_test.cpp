// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/actuator_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/angles.h"

namespace navcal::gap {
namespace {

constexpr double kTrackLag_s = 0.15;

/// Exact reports of all three fins, ten a second.
std::vector<MotorReading> reports(const std::function<double(double)>& angle_rad, double duration_s) {
  std::vector<MotorReading> readings;
  for (double t = 0.037; t < duration_s; t += 0.1) {
    readings.push_back({t, 780, {angle_rad(t), angle_rad(t), angle_rad(t)}, 1.4});
  }
  return readings;
}

class StepAt : public testing::TestWithParam<double> {};

TEST_P(StepAt, OfACommandIsSharpBetweenTwoReports) {
  const double at_s = GetParam();
  const auto angle = [&](double t) {
    return t < at_s ? 2 * base::kRadiansPerDegree
                    : (15 - 13 * std::exp(-(t - at_s) / kTrackLag_s)) * base::kRadiansPerDegree;
  };
  const ActuatorTrack track(reports(angle, 6), std::vector{1.0, at_s, 5.0}, {}, kTrackLag_s, {}, 6);
  for (std::size_t k = 100; k < 500; ++k) {
    const double t = static_cast<double>(k) * ActuatorTrack::kStep_s;
    EXPECT_NEAR(track.rows()[k].fins_rad[0], angle(t), 0.1 * base::kRadiansPerDegree) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(WhereverItIs, StepAt, testing::Values(3.04, 3.05, 3.07, 3.1, 3.12, 3.13));

// A servo that was told something right after a report is ahead of the straight line to the next one by 5 ms: on a
// swing that was 360 nats of evidence for a gap that was none.
TEST(ActuatorTrack, FollowsAHelmWithoutLeadOrLag) {
  for (const double phase_s : {0.0, 0.03, 0.05, 0.08}) {
    const auto orders_s = regular_orders(phase_s, 20);
    const auto angle = [&](double t) {
      double servo = 0, command = 0, at_s = 0;
      for (const double order_s : orders_s) {
        const double until_s = std::min(order_s, t);
        servo = command + (servo - command) * std::exp(-(until_s - at_s) / kTrackLag_s);
        at_s = until_s;
        if (order_s > t) return servo;
        command = 8 * base::kRadiansPerDegree * std::sin(1.3 * order_s);
      }
      return command + (servo - command) * std::exp(-(t - at_s) / kTrackLag_s);
    };
    const ActuatorTrack track(reports(angle, 20), orders_s, {}, kTrackLag_s, {}, 20);
    double early = 0, size = 0;
    for (std::size_t k = 200; k < 1800; ++k) {
      const double t = static_cast<double>(k) * ActuatorTrack::kStep_s;
      const double slope = (angle(t + 0.05) - angle(t - 0.05)) / 0.1;
      early += (track.rows()[k].fins_rad[1] - angle(t)) * slope;
      size += slope * slope;
    }
    EXPECT_LT(std::abs(early / size), 0.001) << phase_s;  // seconds
  }
}

TEST(ActuatorTrack, ASteadyFinLosesTheNoiseOfItsReports) {
  int sign = 1;
  const auto noisy = [&](double) { return (5 + 0.1 * (sign = -sign)) * base::kRadiansPerDegree; };
  const ActuatorTrack track(reports(noisy, 20), regular_orders(0, 20), {}, kTrackLag_s, {}, 20);
  for (std::size_t k = 200; k < 1800; ++k)
    EXPECT_NEAR(track.rows()[k].fins_rad[2], 5 * base::kRadiansPerDegree, 0.03 * base::kRadiansPerDegree);
}

TEST(ActuatorTrack, OneReportHoldsForAll) {
  const std::vector<MotorReading> one{{3, 600, {0.1, 0.2, 0.3}, 1}};
  const ActuatorTrack track(one, regular_orders(0, 5), {}, kTrackLag_s, {}, 5);
  EXPECT_GE(track.rows().size(), 500U);
  for (const auto& row : track.rows()) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(row.fins_rad[i], 0.1 * static_cast<double>(i + 1), 1e-12);
    EXPECT_EQ(row.shaft_rps, 10);
  }
}

TEST(ActuatorTrack, TheCurrentIsThatOfTheShaftAndWhatTheReportsAddToItForSeconds) {
  const auto readings = reports([](double) { return 0; }, 60);  // 1.4 A
  const ActuatorTrack track(readings, regular_orders(0, 60), {}, kTrackLag_s, {}, 60);
  const std::vector<double> nominal(track.rows().size(), 1.0);
  const auto current = track.current_A(readings, nominal);
  for (std::size_t k = 1000; k < 5000; ++k) EXPECT_NEAR(current[k], 1.4, 0.01);
}

}  // namespace
}  // namespace navcal::gap
