// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/regimes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "gap/verdict/where.h"

namespace navcal::gap {
namespace {

constexpr std::size_t kCircleRows = 4000;

Trajectory10Hz circling_motion() {
  Trajectory10Hz course;
  for (std::size_t i = 0; i < kCircleRows; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    course.time_s.push_back(t);
    course.heading_rad.push_back(0.11 * t);
    course.current_A.push_back(1 + 0.5 * std::sin(0.03 * t));
    for (auto* const column :
         {&course.roll_rad, &course.pitch_rad, &course.yaw_rate_rad_s, &course.pitch_rate_rad_s, &course.depth_m,
          &course.surge_m_s, &course.temperature_rise_C, &course.rudder_rad, &course.elevator_rad,
          &course.shaft_rps}) {
      column->push_back(1);
    }
  }
  return course;
}

Innovations noise(std::uint64_t seed) {
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  Innovations made;
  made.grid = Eigen::MatrixXd::NullaryExpr(kCircleRows, kChannels, [&] { return 0.1 * normal(dice); });
  return made;
}

RegimeStatistics nulls(const Trajectory10Hz& course) {
  std::vector<Eigen::MatrixXd> all;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) all.push_back(explained_rms(noise(seed), course, {}));
  return RegimeStatistics(all);
}

TEST(Regimes, TheWholeOfAChannelIsTheLastOfThem) {
  EXPECT_EQ(regimes().at(static_cast<std::size_t>(overall_regime())), "overall");
  EXPECT_EQ(static_cast<Eigen::Index>(regimes().size()), overall_regime() + 1);
  const Eigen::MatrixXd shown = explained_rms(noise(1), circling_motion(), {});
  ASSERT_EQ(shown.cols(), overall_regime() + 1);
  EXPECT_NEAR(shown(0, overall_regime()), 0.1 * 180 / 3.14159265, 0.2);  // the heading, in degrees
}

// The first seconds are left out of the residuals. A speed that changes in these seconds only is constant in the
// others: a constant residual does not follow it. Six of nineteen nulls of a short mission ended as unknown by
// that.
TEST(Regimes, AConstantResidualFollowsNothingButTheConstant) {
  Trajectory10Hz course = circling_motion();
  for (std::size_t i = 0; i < 150; ++i) course.surge_m_s[i] = 0.2;
  Innovations shifted = noise(3);
  shifted.grid.setConstant(0.5);
  const Eigen::MatrixXd shown = explained_rms(shifted, course, {});
  for (std::size_t k = 0; k < regimes().size(); ++k) {
    const auto regime = static_cast<Eigen::Index>(k);
    if (regimes()[k] == "constant" || regime == overall_regime()) continue;
    for (Eigen::Index c = 0; c < shown.rows(); ++c)
      EXPECT_NEAR(shown(c, regime), 0, 1e-9) << c << ' ' << regimes()[k];
  }
}

// On a straight course the rudder follows the compass's noise, by which it is steered, and not the noise the
// rudder.
TEST(Where, ARudderThatOnlyHoldsTheCourseIsFollowedByNothing) {
  Trajectory10Hz steered = circling_motion(), not_steered = circling_motion();
  const Innovations seen = noise(7);
  for (std::size_t i = 0; i < kCircleRows; ++i) {
    const double wander = 0.002 * std::sin(0.7 * static_cast<double>(i));
    not_steered.rudder_rad[i] = wander;
    steered.rudder_rad[i] = 0.02 * seen.grid(static_cast<Eigen::Index>(i), heading);
  }
  const auto statistics = nulls(not_steered);
  for (const WhereEntry& entry : residual_map(explained_rms(seen, steered, {}), statistics)) {
    EXPECT_NE(entry.regime, "rudder") << entry.channel;
  }
  for (double& angle : steered.rudder_rad) angle *= 20;
  for (double& angle : not_steered.rudder_rad) angle *= 20;
  const auto where = significant_cells(residual_map(explained_rms(seen, steered, {}), nulls(not_steered)));
  ASSERT_FALSE(where.empty());
  EXPECT_EQ(where.front().regime, "rudder");
}

TEST(Where, NoiseIsNowhere) {
  const Trajectory10Hz course = circling_motion();
  const auto statistics = nulls(course);
  int found = 0;
  for (std::uint64_t seed = 100; seed < 120; ++seed) {
    found += static_cast<int>(
        significant_cells(residual_map(explained_rms(noise(seed), course, {}), statistics)).size());
  }
  EXPECT_LE(found, 1);
}

TEST(Where, WhatFollowsTheCurrentIsFoundThere) {
  const Trajectory10Hz course = circling_motion();
  Innovations made = noise(200);
  for (std::size_t i = 0; i < kCircleRows; ++i) {
    made.grid(static_cast<Eigen::Index>(i), field_y) += 0.2 * course.current_A[i];
  }
  const auto map = residual_map(explained_rms(made, course, {}), nulls(course));
  EXPECT_EQ(map.front().channel, "compass.field");
  const auto clear = significant_cells(map);
  const bool current = std::any_of(clear.begin(), clear.end(), [](const WhereEntry& entry) {
    return entry.channel == "compass.field" && entry.regime == "motor_current" && entry.unit == "uT" &&
           std::abs(entry.gap - 0.2 * 0.5 / std::sqrt(2.0)) < 0.02;
  });
  EXPECT_TRUE(current);
  for (const WhereEntry& entry : clear) EXPECT_EQ(entry.channel, "compass.field");
}

// Iron and misalignment turn with the heading once and twice; what is left three times is no map of straight
// lines.
TEST(Where, AFieldThatSaturatesFollowsTheHeadingThrice) {
  const Trajectory10Hz course = circling_motion();
  Innovations made = noise(210);
  for (std::size_t i = 0; i < kCircleRows; ++i) {
    const double along_uT = 20 * std::cos(course.heading_rad[i]);
    made.grid(static_cast<Eigen::Index>(i), field_x) -=
        2e-5 * std::pow(along_uT, 3) - 0.75 * 2e-5 * 400 * along_uT;
  }
  const auto clear = significant_cells(residual_map(explained_rms(made, course, {}), nulls(course)));
  ASSERT_FALSE(clear.empty());
  EXPECT_EQ(clear.front().channel, "compass.field");
  EXPECT_EQ(clear.front().regime, "heading_thrice");
  EXPECT_NEAR(clear.front().gap, 2e-5 * 8000 / 4 / std::sqrt(2.0), 0.01);
}

// On a course that goes there and back the first harmonic looks like the third, and irons of vehicles without a
// gap would hide it.
TEST(Where, TheThirdHarmonicIsSeenBesideIrons) {
  Trajectory10Hz course = circling_motion();
  for (double& heading : course.heading_rad) heading += 1.2 * std::sin(2 * heading) + 0.6 * std::sin(heading);
  const auto with_field = [&](std::uint64_t seed, const std::function<double(double)>& field_uT) {
    Innovations made = noise(seed);
    for (std::size_t i = 0; i < kCircleRows; ++i) {
      made.grid(static_cast<Eigen::Index>(i), field_x) += field_uT(course.heading_rad[i]);
    }
    return explained_rms(made, course, {});
  };
  std::vector<Eigen::MatrixXd> irons;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const double size_uT = 0.02 * (static_cast<double>(seed) - 20.5);
    irons.push_back(with_field(seed, [&](double heading_rad) { return size_uT * std::cos(heading_rad); }));
  }
  const auto clear = significant_cells(
      residual_map(with_field(220, [](double heading_rad) { return 0.04 * std::cos(3 * heading_rad); }),
                   RegimeStatistics(irons)));
  ASSERT_FALSE(clear.empty());
  EXPECT_EQ(clear.front().regime, "heading_thrice");
}

TEST(Where, AStepInMidMissionIsAChange) {
  const Trajectory10Hz course = circling_motion();
  Innovations made = noise(300);
  for (std::size_t i = kCircleRows / 2; i < kCircleRows; ++i)
    made.grid(static_cast<Eigen::Index>(i), depth) += 0.5;
  const auto changes = change_points(made, course, {}, nulls(course));
  ASSERT_FALSE(changes.empty());
  EXPECT_EQ(changes.front().channel, "imu.depth");
  EXPECT_NEAR(changes.front().time_s, 200, 15);
  EXPECT_TRUE(change_points(noise(301), course, {}, nulls(course)).empty());
}

}  // namespace
}  // namespace navcal::gap
