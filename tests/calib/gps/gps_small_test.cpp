// SPDX-License-Identifier: Apache-2.0
// The smaller parts about GPS: track and fixes brought together, speed by the propeller, the course fit.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "calib/gps/gps_coefficients.h"
#include "calib/gps/gps_track.h"
#include "calib/gps/gps_water_speed.h"
#include "tests/calib/gps/gps_course_fit.h"
#include "tests/calib/gps_paths.h"

namespace navcal::calib {
namespace {

using namespace test;

struct Heard {
  std::vector<double> ends_s, fixes_rad;
  int lost = 0;
};

Heard heard(GpsTrack& track, const std::vector<WaterTrackReading>& readings) {
  Heard result;
  for (const auto& reading : readings)
    track.update(
        reading, [&](const auto&, const auto& end) { result.ends_s.push_back(end.time_s); },
        [&](const auto&, const auto& at) { result.fixes_rad.push_back(at.heading_rad); }, [&] { ++result.lost; });
  return result;
}

TEST(GpsTrack, AFixMeetsTheTrackAtItsInstantAcrossTheSeam) {
  GpsTrack track;
  GroundReading ground;
  ground.time_s = 10.25;
  track.update(ground);
  const auto result = heard(track, {{10, 6.2, 0, 1}, {10.5, 0.1, 0, 1}});
  ASSERT_EQ(result.fixes_rad.size(), 1U);
  EXPECT_NEAR(std::remainder(result.fixes_rad[0] - (6.2 + 0.1 + 2 * std::numbers::pi) / 2, 2 * std::numbers::pi),
              0, 1e-12);
  EXPECT_EQ(result.ends_s, (std::vector<double>{10.25, 10.5}));
}

TEST(GpsTrack, FixesWithoutTrackAreLeftOutAndGapsAreTold) {
  GpsTrack track;
  GroundReading ground;
  ground.time_s = 12;
  track.update(ground);
  const auto result = heard(track, {{10, 0, 0, 1}, {15, 0, 0, 1}, {15.1, 0, 0, 1}});
  EXPECT_TRUE(result.fixes_rad.empty());
  EXPECT_EQ(result.lost, 1);
  EXPECT_EQ(track.left_out(), 1U);
  EXPECT_EQ(result.ends_s, std::vector<double>{15.1});
}

TEST(WaterSpeed, FollowsTheShaftAndForgetsHowItBegan) {
  WaterSpeed speed;
  EXPECT_FALSE(speed.at(0));
  speed.update({.time_s = 0, .rpm = 780});
  EXPECT_NEAR(*speed.at(0), 1.134, 2e-3);  // the reference vehicle at 13 rev/s
  speed.update({.time_s = 1, .rpm = 0});
  EXPECT_LT(*speed.at(30), 0.3);
  speed.update({.time_s = 30, .rpm = 600});
  double before = *speed.at(30);
  for (double t = 30.5; t < 60; t += 0.5) {
    const double now = *speed.at(t);
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_NEAR(before, 0.872, 2e-3);
  speed.update({.time_s = 61, .rpm = std::numeric_limits<double>::quiet_NaN()});
  EXPECT_TRUE(std::isfinite(*speed.at(62)));
  speed.update({.time_s = 63, .rpm = -600});
  EXPECT_GE(*speed.at(1e9), 0);
}

TEST(GpsCourseFit, EqualsTheBatchSolutionAndHasTheThesisFigures) {
  Random random(1);
  GpsNoise noise;
  noise.interval_s = 0.1;
  const GpsRun run = measure_by_gps(load_true_path("path_long600"), gps_deviation(), noise, random);
  GpsCourseFit fit;
  feed(fit, run);
  const GpsCourseFit::Parameters p;
  GpsCourseFit::Matrix information =
      GpsCourseFit::Matrix::Identity() / (p.deviation_std_rad * p.deviation_std_rad);
  GpsCourseFit::Vector right = GpsCourseFit::Vector::Zero();
  for (std::size_t k = 0; k < run.ground.size(); ++k) {
    if (run.ground[k].speed_m_s < p.least_speed_m_s) continue;
    const double psi = run.track[k].heading_rad;
    const auto f = deviation_harmonics(psi);
    const double weight = std::pow(run.ground[k].speed_m_s / p.velocity_std_m_s, 2);
    information += weight * f * f.transpose();
    right += weight * f * std::remainder(psi - *run.ground[k].course_rad, 2 * std::numbers::pi);
  }
  EXPECT_LT((fit.estimate() - information.llt().solve(right)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(worst_residual_rad(fit.estimate(), gps_deviation()) * 180 / std::numbers::pi, 0.29, 0.01);
}

}  // namespace
}  // namespace navcal::calib
