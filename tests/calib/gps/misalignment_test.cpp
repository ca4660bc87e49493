// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/misalignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <string_view>

#include "base/angles.h"

namespace navcal::calib {
namespace {

constexpr double kOffset_rad = 3 * base::kRadiansPerDegree;
constexpr double kSpeed_m_s = 1.1;

Misalignment::Parameters quiet_parameters() {
  Misalignment::Parameters parameters;
  parameters.run_std_rad = 0;
  return parameters;
}

/// A vehicle with a helmsman; headings ten times a second, fixes once.
struct Voyage {
  Misalignment& misalignment;
  double position_std_m = 2.5, heading_std_rad = 0.004, wander_rad = 0, deviation_rad = 0;
  Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();
  int harmonic = 1;  ///< of the deviation; the first is that of a current, which cannot be as large
  std::mt19937_64 random{1};
  int tick = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();

  void go(double heading_rad, double duration_s, double turn_rate_rad_s = 0) {
    std::normal_distribution<double> normal;
    const int ticks = static_cast<int>(std::lround(duration_s * 10));
    for (int k = 0; k < ticks; ++k, ++tick) {
      const double time_s = tick / 10.0;
      const double psi = heading_rad + turn_rate_rad_s * k / 10.0 + wander_rad * std::sin(0.4 * time_s);
      misalignment.update_heading(
          time_s, psi + kOffset_rad + deviation_rad * std::cos(harmonic * psi) + heading_std_rad * normal(random));
      const Eigen::Vector2d velocity = kSpeed_m_s * Eigen::Vector2d(std::cos(psi), std::sin(psi)) + current_m_s;
      if (tick % 10 == 0) {
        GroundReading ground;
        ground.time_s = time_s;
        ground.position_m = position_m + position_std_m * Eigen::Vector2d(normal(random), normal(random));
        ground.speed_m_s = velocity.norm();
        misalignment.update(ground);
      }
      position_m += 0.1 * velocity;
    }
  }
  void turn(double from_rad, double by_rad) { go(from_rad, std::abs(by_rad) / 0.3, by_rad > 0 ? 0.3 : -0.3); }
};

TEST(Misalignment, OfOneRunIsAsAccurateAsTheThesisSays) {
  // sigma_A = sigma_p sqrt(12) / (L sqrt(N)), by Monte Carlo.
  double square = 0, stated = 0;
  int within = 0;
  const int runs = 300;
  for (unsigned i = 1; i <= runs; ++i) {
    Misalignment misalignment(quiet_parameters());
    Voyage voyage{misalignment};
    voyage.random.seed(i);
    voyage.go(0.4, 103);
    const auto estimate = misalignment.estimate();
    ASSERT_TRUE(estimate);
    const double error = estimate->offset_rad - kOffset_rad;
    square += error * error;
    stated = estimate->offset_std_without_current_rad;
    within += std::abs(error) <= 2 * stated ? 1 : 0;
  }
  const auto line_length_m = 99 * kSpeed_m_s, fixes = 100.0;
  EXPECT_NEAR(stated, 2.5 * std::sqrt(12) / (line_length_m * std::sqrt(fixes)), 0.05 * stated);
  EXPECT_NEAR(std::sqrt(square / runs) / stated, 1, 0.14);  // 99.9 % of a chi of 300
  EXPECT_GE(within, 275);
}

TEST(Misalignment, WhatTheHelmsmanWandersCancels) {
  Misalignment misalignment(quiet_parameters());
  Voyage voyage{misalignment, 0, 0};
  voyage.wander_rad = 0.1;
  voyage.go(2, 137);
  ASSERT_TRUE(misalignment.estimate());
  EXPECT_NEAR(misalignment.estimate()->offset_rad, kOffset_rad, 2e-4);
}

TEST(Misalignment, RunsBothWaysTellTheCurrentFromIt) {
  Misalignment misalignment(quiet_parameters());
  Voyage voyage{misalignment, 0.2, 0};
  voyage.current_m_s = {0.1, -0.08};
  for (const double heading :
       {0.0, 90 * base::kRadiansPerDegree, 180 * base::kRadiansPerDegree, 270 * base::kRadiansPerDegree}) {
    voyage.go(heading, 150);
    voyage.turn(heading, 90 * base::kRadiansPerDegree);
  }
  const auto estimate = misalignment.estimate();
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->runs, 4U);
  EXPECT_NEAR(estimate->offset_rad, kOffset_rad, 0.002);
  EXPECT_LT((estimate->current_m_s - voyage.current_m_s).norm(), 0.01);
  EXPECT_GT(estimate->direction_balance, 0.8);
  EXPECT_TRUE(misalignment.judgement().accepted);
}

// Four legs of an uncalibrated compass said -21, -79, 94 and 30 degrees; their mean was accepted with 0.6.
TEST(Misalignment, RunsThatContradictEachOtherAreNoMisalignment) {
  for (const auto& [deviation_deg, harmonic] : {std::pair{0.0, 1}, {40.0, 1}, {5.0, 2}}) {
    Misalignment misalignment;
    Voyage voyage{misalignment};
    voyage.deviation_rad = deviation_deg * base::kRadiansPerDegree;
    voyage.harmonic = harmonic;
    for (const double heading :
         {0.0, 90 * base::kRadiansPerDegree, 180 * base::kRadiansPerDegree, 270 * base::kRadiansPerDegree}) {
      voyage.go(heading, 300);
      voyage.turn(heading, 90 * base::kRadiansPerDegree);
    }
    const Judgement judgement = misalignment.judgement();
    const auto estimate = misalignment.estimate();
    ASSERT_TRUE(estimate);
    EXPECT_EQ(judgement.accepted, deviation_deg == 0) << deviation_deg;
    EXPECT_LT(std::abs(estimate->offset_rad - kOffset_rad), 3 * estimate->offset_std_rad) << deviation_deg;
    if (deviation_deg > 0) {
      EXPECT_NE(judgement.reason.find("contradict each other"), std::string::npos);
    }
  }
}

TEST(Misalignment, OneWayAloneSaysThatACurrentCouldFeignIt) {
  Misalignment misalignment;
  Voyage voyage{misalignment, 0.5};
  voyage.current_m_s = {0, 0.12};
  voyage.go(0, 250);
  const auto estimate = misalignment.estimate();
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(estimate->offset_std_rad, 0.15 / kSpeed_m_s, 0.02);
  EXPECT_LT(std::abs(estimate->offset_rad - kOffset_rad), 2 * estimate->offset_std_rad);
  const Judgement judgement = misalignment.judgement();
  EXPECT_FALSE(judgement.accepted);
  EXPECT_EQ(judgement.reason, "all runs lead one way: a current could feign the misalignment");
}

TEST(Misalignment, TurnsStandstillAndShortRunsGiveNothing) {
  Misalignment misalignment;
  Voyage voyage{misalignment};
  for (int i = 0; i < 10; ++i) {
    voyage.go(i, 15);
    voyage.go(i, 40, 0.2);
  }
  EXPECT_FALSE(misalignment.estimate());
  // At rest the receiver holds its position.
  for (int k = 0; k < 3000; ++k) {
    const double time_s = 1000 + k / 10.0;
    misalignment.update_heading(time_s, 1);
    GroundReading ground;
    ground.time_s = time_s;
    if (k % 10 == 0) misalignment.update(ground);
  }
  EXPECT_FALSE(misalignment.estimate());
  EXPECT_GE(misalignment.run().left_out().slow, 300U);
  EXPECT_FALSE(misalignment.judgement().accepted);
}

TEST(Misalignment, JumpsAndNotANumberAreLeftOut) {
  Misalignment clean(quiet_parameters()), spoiled(quiet_parameters());
  Voyage one{clean}, other{spoiled};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  one.go(1, 103);
  other.go(1, 53);
  for (int i = 0; i < 2; ++i) {
    GroundReading jump;
    jump.time_s = other.tick / 10.0 - 0.05 + 0.01 * i;
    jump.position_m = other.position_m + Eigen::Vector2d(60, 60);
    jump.speed_m_s = 1;
    spoiled.update(jump);
  }
  spoiled.update_heading(nan, 1);
  spoiled.update_heading(other.tick / 10.0, nan);
  GroundReading bad;
  bad.time_s = other.tick / 10.0;
  bad.position_m = {nan, 0};
  bad.speed_m_s = 1;
  spoiled.update(bad);
  other.go(1, 50);
  EXPECT_EQ(spoiled.run().left_out().jumps, 2U);
  EXPECT_DOUBLE_EQ(spoiled.estimate()->offset_rad, clean.estimate()->offset_rad);
}

TEST(Misalignment, ARunIsEndedByAGapAndTheSeamDoesNotMatter) {
  Misalignment misalignment(quiet_parameters());
  Voyage voyage{misalignment, 0.1, 0};
  voyage.go(std::numbers::pi, 60);
  voyage.tick += 200;
  voyage.go(std::numbers::pi, 60);
  const auto estimate = misalignment.estimate();
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->runs, 2U);
  EXPECT_NEAR(estimate->offset_rad, kOffset_rad, 0.003);
}

TEST(Misalignment, ALongRunIsTakenAsSeveralInBoundedMemory) {
  Misalignment misalignment(quiet_parameters());
  Voyage voyage{misalignment, 0.5};
  voyage.go(1, 3000);
  EXPECT_GE(misalignment.estimate()->runs, 9U);
}

TEST(Misalignment, SavedAndRestoredItGoesOnBitForBit) {
  const auto saved = [](Misalignment& misalignment) {
    Archive archive;
    misalignment.archive(archive);
    return archive.bytes();
  };
  Misalignment first, second;
  Voyage voyage{first};
  voyage.go(0.3, 100);
  voyage.turn(0.3, 3);
  voyage.go(3.3, 50);
  const std::string bytes = saved(first);
  Archive restoring{std::string_view(bytes)};
  second.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  Voyage on{second};
  on.tick = voyage.tick;
  on.position_m = voyage.position_m;
  on.random = voyage.random;
  on.go(3.3, 60);
  voyage.go(3.3, 60);
  EXPECT_EQ(saved(second), saved(first));
}

}  // namespace
}  // namespace navcal::calib
