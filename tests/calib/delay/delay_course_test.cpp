// SPDX-License-Identifier: Apache-2.0
#include "calib/delay/delay_course.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <string_view>

namespace navcal::calib {
namespace {

double course_heading(double t) { return 0.15 * t + 1.5 * std::sin(0.25 * t); }
double course_rate(double t) { return 0.15 + 0.375 * std::cos(0.25 * t); }

struct Way {
  double delay_s = 0.3, slip_s = -0.17, speed_m_s = 1.1, noise_m_s = 0, offset_rad = 0.05;
  Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();
};

WaterTrackReading track_at(double t, const Way& way) {
  return {.time_s = t,
          .heading_rad = std::remainder(course_heading(t) + way.offset_rad, 2 * std::numbers::pi),
          .turn_rate_rad_s = course_rate(t),
          .speed_m_s = way.speed_m_s};
}

GroundReading ground_at(double t, const Way& way, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double course = course_heading(t - way.delay_s) + way.slip_s * course_rate(t - way.delay_s);
  const Eigen::Vector2d velocity = way.speed_m_s * Eigen::Vector2d(std::cos(course), std::sin(course)) +
                                   way.current_m_s +
                                   way.noise_m_s * Eigen::Vector2d(normal(random), normal(random));
  GroundReading ground;
  ground.time_s = t;
  ground.speed_m_s = velocity.norm();
  ground.course_rad = std::atan2(velocity.y(), velocity.x());
  return ground;
}

void feed(CourseDelay& delay, const Way& way, double begin_s, double end_s, std::mt19937_64& random) {
  for (int k = static_cast<int>(begin_s * 10); k < end_s * 10; ++k) {
    if (k % 10 == 0) delay.update(ground_at(k / 10.0, way, random));
    delay.update(track_at(k / 10.0, way));
  }
}

TEST(CourseDelay, DelayLessSlipIsWhatTheDataTell) {
  std::mt19937_64 random(1);
  const Way way;
  CourseDelay delay;
  feed(delay, way, 0, 300, random);
  EXPECT_NEAR(delay.less_slip().delay_s, way.delay_s - way.slip_s, 0.02);
  // Known no better than the slip is; the slip of the prior is 0.02 s off the true one.
  EXPECT_NEAR(delay.estimate().delay_s, way.delay_s, 0.05);
  EXPECT_GE(delay.estimate().std_s, 0.1);
}

TEST(CourseDelay, CurrentAndMisalignmentAreNotReadAsADelay) {
  std::mt19937_64 random(1);
  Way way;
  way.current_m_s = {0.1, -0.05};
  way.offset_rad = 0.3;
  CourseDelay delay;
  feed(delay, way, 0, 600, random);
  EXPECT_NEAR(delay.less_slip().delay_s, way.delay_s - way.slip_s, 0.05);
}

TEST(CourseDelay, StandardErrorIsHonest) {
  int within = 0;
  Way way;
  way.delay_s = 0.05;  // the second order of the delay is small
  way.noise_m_s = 0.1;
  for (unsigned run = 1; run <= 200; ++run) {
    std::mt19937_64 random(run);
    CourseDelay::Parameters parameters;
    parameters.course_floor_rad = 0;
    CourseDelay delay(parameters);
    feed(delay, way, 0, 120, random);
    const Delay found = delay.less_slip();
    within += std::abs(found.delay_s - (way.delay_s - way.slip_s)) <= 2 * found.std_s ? 1 : 0;
  }
  EXPECT_GE(within, 181);  // 95.4 % of 200: 99.9 % binomial limits
  EXPECT_LE(within, 199);
}

TEST(CourseDelay, EqualsTheBatchSolution) {
  std::mt19937_64 random(1), same(1);
  Way way;
  way.noise_m_s = 0.05;
  CourseDelay delay;
  feed(delay, way, 0, 100, random);
  const CourseDelay::Parameters p;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  information.diagonal().head<5>().setConstant(std::pow(p.deviation_std_rad, -2));
  information(5, 5) = std::pow(p.delay_std_s, -2);
  for (int t = 0; t < 100; ++t) {
    const GroundReading ground = ground_at(t, way, same);
    const WaterTrackReading track = track_at(t, way);
    Eigen::Matrix<double, 6, 1> row;
    const double psi = track.heading_rad;
    row << 1, std::sin(psi), std::cos(psi), std::sin(2 * psi), std::cos(2 * psi), track.turn_rate_rad_s;
    const double weight =
        1 / (std::pow(p.course_floor_rad, 2) + std::pow(p.velocity_std_m_s / ground.speed_m_s, 2));
    information += weight * row * row.transpose();
    right += weight * row * std::remainder(psi - *ground.course_rad, 2 * std::numbers::pi);
  }
  EXPECT_NEAR(delay.less_slip().delay_s, information.llt().solve(right)[5], 1e-9);
}

TEST(CourseDelay, WithoutTurnsNothingIsClaimed) {
  CourseDelay delay;
  std::mt19937_64 random(1);
  for (int k = 0; k < 3000; ++k) {
    GroundReading ground;
    ground.time_s = k / 10.0;
    ground.speed_m_s = 1;
    ground.course_rad = 0.7;
    if (k % 10 == 0) delay.update(ground);
    delay.update(WaterTrackReading{.time_s = k / 10.0, .heading_rad = 0.75, .speed_m_s = 1});
  }
  EXPECT_GT(delay.less_slip().std_s, 1);
}

TEST(CourseDelay, SlowFixesGapsAndNotANumberAreLeftOut) {
  std::mt19937_64 random(1);
  const Way way;
  CourseDelay delay;
  for (int k = 0; k < 3000; ++k) {
    const double t = k / 10.0;
    if (k % 500 > 480) continue;
    auto ground = ground_at(t, way, random);
    if (k % 70 == 0) ground.course_rad = std::numeric_limits<double>::quiet_NaN();
    if (k % 90 == 0) ground.course_rad.reset();
    if (k % 110 == 0) {  // the receiver holds its position
      ground.speed_m_s = 0;
      ground.course_rad = 0;
    }
    if (k % 10 == 0) delay.update(ground);
    auto track = track_at(t, way);
    if (k % 37 == 0) track.heading_rad = std::numeric_limits<double>::infinity();
    delay.update(track);
  }
  EXPECT_NEAR(delay.less_slip().delay_s, way.delay_s - way.slip_s, 0.03);
}

TEST(CourseDelay, SavedAndRestoredItGoesOnBitForBit) {
  const auto saved = [](CourseDelay& delay) {
    Archive archive;
    delay.archive(archive);
    return archive.bytes();
  };
  std::mt19937_64 random(3), same(3);
  CourseDelay whole, first;
  feed(whole, {}, 0, 100, random);
  feed(first, {}, 0, 50, same);
  const std::string bytes = saved(first);
  CourseDelay second;
  Archive restoring{std::string_view(bytes)};
  second.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  feed(second, {}, 50, 100, same);
  EXPECT_EQ(saved(second), saved(whole));
}

}  // namespace
}  // namespace navcal::calib
