// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/turn_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace navcal::calib {
namespace {

constexpr double kScaleTrue = 1.1, kBiasTrue = -0.1;

/// Turns both ways, without noise unless told.
TurnStep step_at(int i, double start_rad = 0, double noise_rad = 0) {
  static std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto heading = [&](int k) { return start_rad + 6 * (1 - std::cos(0.02 * k)); };
  TurnStep step;
  step.time_s = 0.1 * i;
  step.begins_segment = i == 0;
  if (i > 0) {
    step.duration_s = step.bias_time_s = 0.1;
    step.measured_angle_rad = (heading(i) - heading(i - 1) - 0.1 * kBiasTrue) / kScaleTrue;
  }
  step.heading_rad = std::remainder(heading(i) + noise_rad * normal(random), 2 * M_PI);
  return step;
}

std::string saved(TurnFilter filter) {
  Archive archive;
  archive(filter);
  return archive.bytes();
}

TEST(TurnFilter, FindsScaleAndBiasWhateverTheHeadingBeginsWith) {
  for (const double start : {0.0, 3.1, -3.1, 6.2, 100.0}) {
    TurnFilter filter({}, TurnPrior::unknown_gyro());
    for (int i = 0; i < 500; ++i) filter.update(step_at(i, start));
    EXPECT_NEAR(filter.estimate()[kScale], kScaleTrue, 1e-5);
    EXPECT_NEAR(filter.estimate()[kBias], kBiasTrue, 1e-5);
    EXPECT_LT(filter.condition(), 10);
  }
}

TEST(TurnFilter, WithoutTurnNothingIsClaimed) {
  TurnFilter filter({}, TurnPrior::unknown_gyro());
  for (int i = 0; i < 5000; ++i) {
    TurnStep step;
    step.time_s = 0.1 * i;
    step.begins_segment = i == 0;
    step.duration_s = step.bias_time_s = i == 0 ? 0 : 0.1;
    filter.update(step);
  }
  EXPECT_TRUE(filter.estimate().allFinite());
  EXPECT_GT(filter.condition(), 1e6);
  EXPECT_GT(filter.covariance()(kScale, kScale), 1);
}

TEST(TurnFilter, ConstantRateTellsScaleAndBiasNotApart) {
  TurnFilter filter({}, TurnPrior::unknown_gyro());
  for (int i = 0; i < 500; ++i) {
    TurnStep step;
    step.time_s = 0.1 * i;
    step.begins_segment = i == 0;
    if (i > 0) {
      step.duration_s = step.bias_time_s = 0.1;
      step.measured_angle_rad = 0.05;
    }
    step.heading_rad = std::remainder(0.045 * i, 2 * M_PI);
    filter.update(step);
  }
  EXPECT_GT(filter.condition(), 1e6);
  EXPECT_GT(filter.covariance()(kScale, kScale), 0.01);
}

TEST(TurnFilter, AGapBeginsASegmentAndLosesNothingLearnt) {
  TurnFilter filter({}, TurnPrior::unknown_gyro());
  for (int i = 0; i < 250; ++i) filter.update(step_at(i));
  filter.begin_segment();
  for (int i = 400; i < 650; ++i) filter.update(step_at(i, 2));
  EXPECT_NEAR(filter.estimate()[kScale], kScaleTrue, 1e-5);
  EXPECT_NEAR(filter.estimate()[kBias], kBiasTrue, 1e-5);
  EXPECT_EQ(filter.left_out(), 0U);
}

TEST(TurnFilter, BadStepsAreLeftOutAndSpoilNothing) {
  TurnFilter filter({}, TurnPrior::unknown_gyro());
  for (int i = 0; i < 500; ++i) {
    TurnStep step = step_at(i);
    if (i == 100) step.heading_rad = std::numeric_limits<double>::quiet_NaN();
    if (i == 150) step.measured_angle_rad = std::numeric_limits<double>::infinity();
    if (i == 200) step.duration_s = 0;
    if (i == 250) step.tilt_angle_rad = std::numeric_limits<double>::quiet_NaN();
    filter.update(step);
  }
  EXPECT_EQ(filter.left_out(), 4U);
  EXPECT_NEAR(filter.estimate()[kScale], kScaleTrue, 1e-5);
  EXPECT_TRUE(filter.covariance().allFinite());
}

TEST(TurnFilter, RestoredGoesOnBitForBit) {
  TurnFilter filter({}, TurnPrior::unknown_both());
  for (int i = 0; i < 300; ++i) filter.update(step_at(i, 0, 0.004));
  const std::string bytes = saved(filter);
  TurnFilter restored({});
  Archive archive{std::string_view(bytes)};
  archive(restored);
  ASSERT_TRUE(archive.ok() && archive.at_end());
  for (int i = 300; i < 400; ++i) {
    const TurnStep step = step_at(i, 0, 0.004);
    filter.update(step);
    restored.update(step);
  }
  EXPECT_EQ(saved(filter), saved(restored));
}

TEST(TurnFilter, WrongNoiseIsSeenAndEnlargesTheCovariance) {
  TurnFilter honest({}, TurnPrior::unknown_gyro()), deceived({}, TurnPrior::unknown_gyro());
  for (int i = 0; i < 2000; ++i) {
    honest.update(step_at(i, 0, 0.004));
    deceived.update(step_at(i, 0, 0.012));
  }
  EXPECT_GT(deceived.reduced_chi_squared(), 4);
  EXPECT_LT(honest.reduced_chi_squared(), 1.1);
  EXPECT_GT(deceived.covariance()(kBias, kBias), 4 * honest.covariance()(kBias, kBias));
}

TEST(TurnFilter, BiasThatWalksIsFollowed) {
  TurnFilter::Parameters p;
  p.bias_walk_rad_s_sqrt_s = 3e-4;
  TurnFilter filter(p, TurnPrior::unknown_gyro());
  constexpr double kRamp = 5 * M_PI / 180 / 60 / 60;  // 5 degrees a minute each minute
  for (int i = 0; i < 6000; ++i) {
    TurnStep step = step_at(i, 0, 0.004);
    step.measured_angle_rad -= 0.1 * kRamp * step.time_s / kScaleTrue;
    filter.update(step);
  }
  EXPECT_NEAR(filter.estimate()[kBias], kBiasTrue + kRamp * 600, 4 * 2 * M_PI / 180 / 60);
}

}  // namespace
}  // namespace navcal::calib
