#include "gap/actuator_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace navcal::gap {
namespace {

constexpr double kLag_s = 0.15, kDegree = 0.017453292519943295;

/// Reports of all three fins, ten a second.
std::vector<MotorReading> reports(const std::function<double(double)>& angle_rad, double duration_s) {
  std::vector<MotorReading> readings;
  for (double t = 0.037; t < duration_s; t += 0.1) {
    readings.push_back({t, 780, {angle_rad(t), angle_rad(t), angle_rad(t)}, 1.4});
  }
  return readings;
}

double worst(const ActuatorTrack& track, const std::function<double(double)>& angle_rad, double duration_s) {
  double most = 0;
  for (std::size_t k = 100; static_cast<double>(k) * ActuatorTrack::kStep_s < duration_s - 1; ++k) {
    const double t = static_cast<double>(k) * ActuatorTrack::kStep_s;
    most = std::max(most, std::abs(track.rows()[k].fins_rad[0] - angle_rad(t)));
  }
  return most;
}

class StepAt : public testing::TestWithParam<double> {};

TEST_P(StepAt, OfACommandIsFoundBetweenTwoReports) {
  const double at_s = GetParam();
  const auto angle = [&](double t) {
    return t < at_s ? 2 * kDegree : (15 - 13 * std::exp(-(t - at_s) / kLag_s)) * kDegree;
  };
  const ActuatorTrack track(reports(angle, 6), kLag_s, 6);
  EXPECT_LT(worst(track, angle, 6), 0.6 * kDegree);
}

INSTANTIATE_TEST_SUITE_P(WhereverItIs, StepAt, testing::Values(3.04, 3.05, 3.07, 3.1, 3.12, 3.13));

TEST(ActuatorTrack, FollowsWhatMovesSmoothlyWithoutLeadOrLag) {
  const auto angle = [](double t) { return 8 * kDegree * std::sin(1.3 * t); };
  const ActuatorTrack track(reports(angle, 20), kLag_s, 20);
  double early = 0, size = 0;
  for (std::size_t k = 200; k < 1800; ++k) {
    const double t = static_cast<double>(k) * ActuatorTrack::kStep_s;
    const double slope = 8 * kDegree * 1.3 * std::cos(1.3 * t);
    early += (track.rows()[k].fins_rad[1] - angle(t)) * slope;
    size += slope * slope;
  }
  EXPECT_LT(std::abs(early / size), 0.001);  // seconds
}

TEST(ActuatorTrack, ASteadyFinLosesTheNoiseOfItsReports) {
  int sign = 1;
  const auto noisy = [&](double) { return (5 + 0.1 * (sign = -sign)) * kDegree; };
  const ActuatorTrack track(reports(noisy, 20), kLag_s, 20);
  for (std::size_t k = 200; k < 1800; ++k) {
    EXPECT_NEAR(track.rows()[k].fins_rad[2], 5 * kDegree, 0.06 * kDegree);
    EXPECT_NEAR(track.rows()[k].clean_fins_rad[2], 5 * kDegree, 0.03 * kDegree);
  }
}

TEST(ActuatorTrack, OneReportHoldsForAll) {
  const std::vector<MotorReading> one{{3, 600, {0.1, 0.2, 0.3}, 1}};
  const ActuatorTrack track(one, kLag_s, 5);
  EXPECT_GE(track.rows().size(), 500U);
  for (const auto& row : track.rows()) {
    EXPECT_EQ(row.fins_rad, (Vector3{0.1, 0.2, 0.3}));
    EXPECT_EQ(row.shaft_rps, 10);
  }
}

TEST(ActuatorTrack, TheCurrentIsThatOfTheShaftAndWhatTheReportsAddToItForSeconds) {
  const auto readings = reports([](double) { return 0; }, 60);  // 1.4 A
  const ActuatorTrack track(readings, kLag_s, 60);
  const std::vector<double> nominal(track.rows().size(), 1.0);
  const auto current = track.current_A(readings, nominal);
  for (std::size_t k = 1000; k < 5000; ++k) EXPECT_NEAR(current[k], 1.4, 0.01);
}

}  // namespace
}  // namespace navcal::gap
