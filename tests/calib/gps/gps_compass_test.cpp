// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/gps_compass.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "tests/calib/gps_paths.h"

namespace navcal::calib {
namespace {

using namespace test;

constexpr double kDegrees = 180 / std::numbers::pi;
const GpsNoise kNoise{.interval_s = 1, .velocity_std_m_s = 0.05, .position_std_m = 0.5, .heading_std_rad = 0.004};

GpsCompass::Parameters parameters_for(const GpsNoise& noise) {
  GpsCompass::Parameters parameters;
  parameters.summary.velocity_std_m_s = std::max(noise.velocity_std_m_s, 0.002);
  parameters.summary.position_std_m = std::max(noise.position_std_m, 0.01);
  parameters.summary.model_std_m_s = 0.003;
  return parameters;
}

/// Motion that the model describes exactly: slip k r, a scale of speed, current.
std::vector<TruePoint> level_path(double duration_s) {
  std::vector<TruePoint> path;
  const double slip_s = -0.15;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  for (int k = 0; k * 0.1 < duration_s; ++k) {
    const double t = k * 0.1;
    TruePoint point;
    point.time_s = t;
    point.heading_rad = 0.06 * t + 1.2 * std::sin(0.11 * t);
    point.rate_rad_s.z() = 0.06 + 0.132 * std::cos(0.11 * t);
    const double slip = slip_s * point.rate_rad_s.z();
    point.velocity_body_m_s = 1.1 * Eigen::Vector3d(std::cos(slip), std::sin(slip), 0);
    // The mean velocity of the step, as the trapezoid has it.
    const auto velocity = [](double psi) -> Eigen::Vector2d {
      return 1.1 * Eigen::Vector2d(std::cos(psi), std::sin(psi));
    };
    if (k > 0) {
      const TruePoint& before = path.back();
      position += 0.05 * (velocity(before.heading_rad + slip_s * before.rate_rad_s.z()) +
                          velocity(point.heading_rad + slip));
    }
    point.position_m = position;
    path.push_back(point);
  }
  return path;
}

std::string saved(GpsCompass& compass) {
  Archive archive;
  compass.archive(archive);
  return archive.bytes();
}

TEST(GpsCompass, WithoutNoiseItFindsEverything) {
  Random random(1);
  GpsNoise noise;
  noise.current_m_s = {0.12, -0.09};
  auto run = measure_by_gps(level_path(300), gps_deviation(), noise, random);
  for (auto& track : run.track) track.speed_m_s /= 1.08;
  GpsCompass compass(parameters_for(noise));
  feed(compass, run);
  const auto estimate = compass.solve();
  ASSERT_TRUE(estimate && estimate->converged);
  EXPECT_LT(worst_residual_rad(estimate->unknowns.head<5>(), gps_deviation()) * kDegrees, 0.01);
  EXPECT_NEAR(estimate->unknowns[5], 1.08, 2e-3);
  EXPECT_NEAR(estimate->unknowns[6], -0.15, 5e-3);
  EXPECT_NEAR(estimate->unknowns[7], 0.12, 1e-3);
  EXPECT_NEAR(estimate->unknowns[8], -0.09, 1e-3);
}

TEST(GpsCompass, ReachesTheThesisFigureOnTenMinutes) {
  Random random(1);
  GpsCompass compass(parameters_for(kNoise));
  feed(compass, measure_by_gps(load_true_path("path_long600"), gps_deviation(), kNoise, random));
  const auto& estimate = compass.estimate();
  ASSERT_TRUE(estimate);
  EXPECT_LT(worst_residual_rad(estimate->unknowns.head<5>(), gps_deviation()) * kDegrees, 0.6);
  EXPECT_TRUE(compass.judgement().accepted) << compass.judgement().reason;
  EXPECT_EQ(compass.judgement().coverage, 1);
}

TEST(GpsCompass, WhatFitsButIsTooUncertainIsRefused) {
  Random random(1);
  GpsCompass::Parameters parameters = parameters_for(kNoise);
  parameters.accepted_std_rad = 1e-5;
  GpsCompass compass(parameters);
  feed(compass, measure_by_gps(load_true_path("path_long600"), gps_deviation(), kNoise, random));
  const auto& estimate = compass.estimate();
  ASSERT_TRUE(estimate && estimate->converged);
  EXPECT_GT(estimate->worst_std_rad, parameters.accepted_std_rad);
  EXPECT_FALSE(compass.judgement().accepted);
  EXPECT_NE(compass.judgement().reason.find("uncertain by 1 degrees or so"), std::string::npos)
      << compass.judgement().reason;
}

TEST(GpsCompass, AnyMisalignmentAndDeclination) {
  Random random(1);
  for (const double offset : {-3.0, -1.0, 1.5, 3.1}) {
    Deviation deviation = thesis_deviation();
    deviation[0] = offset;
    auto run = measure_by_gps(level_path(200), deviation, GpsNoise{}, random);
    auto parameters = parameters_for({});
    parameters.declination_rad = 0.03;
    for (auto& track : run.track) track.heading_rad -= parameters.declination_rad;
    // E is a function of what the compass says, so its harmonics are turned with it.
    GpsCompass compass(parameters);
    feed(compass, run);
    const auto estimate = compass.solve();
    ASSERT_TRUE(estimate && estimate->converged);
    for (int degree = 0; degree < 360; degree += 10) {
      const double psi = degree / kDegrees;
      const double found = deviation_rad(estimate->unknowns.head<5>(), psi);
      const double truth = deviation_rad(deviation, psi + parameters.declination_rad);
      EXPECT_NEAR(std::remainder(found - truth, 2 * std::numbers::pi), 0, 2e-4) << offset;
    }
  }
}

TEST(GpsCompass, StandardErrorsAreHonest) {
  int within = 0, all = 0;
  const auto path = level_path(120);
  for (unsigned run = 1; run <= 24; ++run) {
    Random random(run);
    GpsCompass compass(parameters_for(kNoise));
    feed(compass, measure_by_gps(path, gps_deviation(), kNoise, random));
    const auto estimate = compass.solve();
    ASSERT_TRUE(estimate);
    for (int k = 0; k < 5; ++k, ++all)
      within += std::abs(estimate->unknowns[k] - gps_deviation()[k]) <= 2 * std::sqrt(estimate->covariance(k, k))
                    ? 1
                    : 0;
  }
  // 95.4 %, the five of a run not independent.
  EXPECT_GE(within, 0.85 * all);
}

TEST(GpsCompass, SlicesComeToTheBatchSolution) {
  Random random(1);
  GpsCompass compass(parameters_for(kNoise));
  const auto run = measure_by_gps(level_path(300), gps_deviation(), kNoise, random);
  feed(compass, run, 0, 3000);
  // The newest slice ends at the newest fix when their number is a multiple of the slice.
  ASSERT_EQ(compass.summary().fixes() % GpsCompass::Parameters{}.slice_fixes, 0U);
  const auto batch = compass.solve();
  ASSERT_TRUE(batch && compass.estimate());
  EXPECT_LT((compass.estimate()->unknowns - batch->unknowns).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((compass.estimate()->covariance - batch->covariance).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(GpsCompass, OneHeadingIsRefusedWithWhatIsMissing) {
  GpsCompass compass;
  std::normal_distribution<double> normal(0, 0.05);
  Random random(1);
  for (int t = 0; t < 300; ++t) {
    GroundReading ground;
    ground.time_s = t;
    ground.position_m = {1.1 * t, 0};
    ground.speed_m_s = 1.1 + normal(random);
    ground.course_rad = normal(random);
    compass.update(ground);
    for (int k = 0; k < 10; ++k) compass.update(WaterTrackReading{t + k / 10.0, 0.05, 0, 1.1});
  }
  const Judgement judgement = compass.judgement();
  EXPECT_FALSE(judgement.accepted);
  EXPECT_NE(judgement.manoeuvre.find("turn through"), std::string::npos) << judgement.manoeuvre;
  EXPECT_LT(judgement.coverage, 0.1);
}

TEST(GpsCompass, BeforeAnyFixItSaysSo) {
  const GpsCompass compass;
  EXPECT_FALSE(compass.estimate());
  EXPECT_FALSE(compass.solve());
  EXPECT_FALSE(compass.judgement().accepted);
}

TEST(GpsCompass, SavedAndRestoredItGoesOnBitForBit) {
  Random random(1);
  const auto run = measure_by_gps(level_path(120), gps_deviation(), kNoise, random);
  GpsCompass whole(parameters_for(kNoise)), first(parameters_for(kNoise)), second(parameters_for(kNoise));
  feed(whole, run);
  feed(first, run, 0, 605);
  const std::string bytes = saved(first);
  Archive restoring{std::string_view(bytes)};
  second.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  feed(second, run, 605, run.track.size());
  EXPECT_EQ(saved(second), saved(whole));
}

}  // namespace
}  // namespace navcal::calib
