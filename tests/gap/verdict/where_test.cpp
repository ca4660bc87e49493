// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/where.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "gap/replay/regimes.h"

namespace navcal::gap {
namespace {

class WhereMap : public testing::Test {
 protected:
  WhereMap() {
    std::vector<Eigen::MatrixXd> of_nulls;
    for (int i = 0; i < 40; ++i) of_nulls.push_back(quiet(1 + 0.02 * (i % 5)));
    nulls_ = RegimeStatistics(of_nulls);
  }
  static Eigen::MatrixXd quiet(double size = 1) {
    return Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(reported_channels().size()),
                                     static_cast<Eigen::Index>(regimes().size()), size);
  }
  static std::string name_of(Eigen::Index channel) {
    return std::string(reported_channels()[static_cast<std::size_t>(channel)].name);
  }
  RegimeStatistics nulls_;
};

TEST_F(WhereMap, PutsFirstWhatIsFurthestBeyondTheNulls) {
  Eigen::MatrixXd explained_rms = quiet();
  explained_rms(3, 1) = 4;
  explained_rms(5, 2) = 2;
  const auto clear = significant_cells(residual_map(explained_rms, nulls_));
  ASSERT_EQ(clear.size(), 2U);
  EXPECT_EQ(clear[0].channel, name_of(3));
  EXPECT_EQ(clear[1].channel, name_of(5));
}

// A wrong tilt turns the depth that is reckoned with it, whose slow part nulls scatter least in: more plainly seen
// there, but a small part of the depth's noise.
TEST_F(WhereMap, PutsALargeExcessBeforeAPlainOne) {
  std::vector<Eigen::MatrixXd> of_nulls;
  for (int i = 0; i < 40; ++i) {
    of_nulls.push_back(quiet(1 + 0.02 * (i % 5)));
    of_nulls.back()(5, 2) /= 50;
  }
  Eigen::MatrixXd explained_rms = quiet();
  explained_rms(3, 1) = 2;
  explained_rms(5, 2) = 0.5;
  const auto clear = significant_cells(residual_map(explained_rms, RegimeStatistics(of_nulls)));
  ASSERT_EQ(clear.size(), 2U);
  EXPECT_EQ(clear[0].channel, name_of(3));
  EXPECT_LT(clear[1].p_value, clear[0].p_value);
}

TEST_F(WhereMap, AnInstrumentALittleNoisierIsNotClearOfNullsHoweverSureThatIs) {
  Eigen::MatrixXd explained_rms = quiet();
  explained_rms(3, 1) = 1.34;
  const auto map = residual_map(explained_rms, nulls_);
  EXPECT_LT(map.front().p_value, 1e-4);
  EXPECT_TRUE(significant_cells(map).empty());
}

// Vehicles known to the last number leave a tenth of what tolerances make: a saturated magnetometer that iron
// nearly explains leaves half a tolerance more than that, and speaks for itself.
TEST_F(WhereMap, WhatIsLeftIsHeldAgainstKnownVehiclesButMustBeMoreThanTolerance) {
  std::vector<Eigen::MatrixXd> of_known;
  for (int i = 0; i < 30; ++i) of_known.push_back(quiet(0.1 + 0.01 * (i % 7)));
  const RegimeStatistics known(of_known);
  Eigen::MatrixXd left = quiet(0.1);
  left(3, 1) = 1.2;  // beyond any known vehicle, but no more than a tolerance
  left(5, 2) = 1.5;
  ASSERT_TRUE(significant_cells(residual_map(quiet(0.1), known)).empty());
  const auto beyond = significant_against_exact_model(left, known, nulls_);
  ASSERT_EQ(beyond.size(), 1U);
  EXPECT_EQ(beyond[0].channel, name_of(5));
  EXPECT_EQ(beyond[0].regime, regimes()[2]);
}

TEST_F(WhereMap, MostChangedIsWhereTheEffectsTakeMostAway) {
  Eigen::MatrixXd before = quiet(), after = quiet();
  before(3, 1) = after(3, 1) = 1.35;  // the loudest, which the effects leave as it is
  before(7, 4) = 1.2;
  const WhereEntry entry = most_changed(residual_map(before, nulls_), before, after, nulls_);
  EXPECT_EQ(entry.channel, name_of(7));
  EXPECT_EQ(entry.regime, regimes()[4]);
}

Eigen::Index channel_named(std::string_view name) {
  std::size_t c = 0;
  while (reported_channels().at(c).name != name) ++c;
  return static_cast<Eigen::Index>(c);
}

TEST_F(WhereMap, TheLeastRatioIsThatOfTheMotionAndOfNothingElse) {
  const double floor = nulls_.floor(0, overall_regime());
  Eigen::MatrixXd shown = quiet(3 * floor);
  shown.row(channel_named("compass.field")).setConstant(floor);
  EXPECT_NEAR(least_ratio(shown, nulls_).value_or(0), 3, 1e-9) << "a compass follows any vehicle";
  shown.row(channel_named("vehicle.speed")).setConstant(2 * floor);
  EXPECT_NEAR(least_ratio(shown, nulls_).value_or(0), 2, 1e-9);
  shown.row(channel_named("imu.gyro")).setConstant(floor);
  EXPECT_NEAR(least_ratio(shown, nulls_).value_or(0), 1, 1e-9);
}

TEST_F(WhereMap, TheLeastRatioTakesThreeChannelsOfTheMotion) {
  Eigen::MatrixXd shown = Eigen::MatrixXd::Zero(quiet().rows(), quiet().cols());
  for (const char* const name : {"imu.gyro", "vehicle.yaw_rate"}) shown.row(channel_named(name)).setConstant(5);
  EXPECT_FALSE(least_ratio(shown, nulls_)) << "what was not measured is no ratio of zero";
  shown.row(channel_named("vehicle.depth_rate")).setConstant(5);
  EXPECT_TRUE(least_ratio(shown, nulls_));
  EXPECT_FALSE(least_ratio(shown, RegimeStatistics({0 * quiet(), 0 * quiet()}))) << "nor is one of no floor";
}

/// A motion of so many intervals, of which the first 20 s do not count, and a heading that is off by this much.
struct Shown {
  explicit Shown(std::size_t intervals, double off_rad) {
    for (std::vector<double>* each :
         {&course.time_s, &course.heading_rad, &course.roll_rad, &course.pitch_rad, &course.yaw_rate_rad_s,
          &course.pitch_rate_rad_s, &course.depth_m, &course.surge_m_s, &course.current_A,
          &course.temperature_rise_C, &course.rudder_rad, &course.elevator_rad, &course.shaft_rps})
      each->assign(intervals, 0);
    for (std::size_t i = 0; i < intervals; ++i) course.time_s[i] = kInterval_s * static_cast<double>(i);
    innovations.grid = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(intervals), kChannels,
                                                 std::numeric_limits<double>::quiet_NaN());
    innovations.grid.col(heading).setConstant(off_rad);
  }
  Trajectory10Hz course;
  Innovations innovations;
};
constexpr double kDegree_rad = std::numbers::pi / 180;

TEST(Courses, AreMeansOfTenSecondsInTheUnitOfTheChannel) {
  Shown before(450, kDegree_rad);
  before.innovations.grid.col(heading).segment(300, 100).setConstant(3 * kDegree_rad);
  before.innovations.grid.col(heading).tail(50).setConstant(-2 * kDegree_rad);
  Innovations after = before.innovations;
  after.grid *= 0.5;
  const auto all = courses(before.innovations, after, before.course, {});
  ASSERT_EQ(all.size(), 1U) << "the heading alone was measured";
  EXPECT_EQ(all[0].channel, "compass.heading");
  EXPECT_EQ(all[0].unit, "deg");
  ASSERT_EQ(all[0].time_s.size(), 3U);
  const std::vector<double> before_deg{1, 3, -2};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(all[0].time_s[i], 25 + 10 * static_cast<double>(i), 1e-9) << "the middle of each piece";
    EXPECT_NEAR(all[0].before[i], before_deg[i], 1e-9);
    EXPECT_NEAR(all[0].after[i], before_deg[i] / 2, 1e-9);
  }
}

TEST(Courses, WhatOnlyOneOfTwoReplaysMeasuredIsNotCompared) {
  const Shown all(400, 0.1);
  Innovations fewer = all.innovations;
  fewer.grid(300, heading) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(courses(all.innovations, fewer, all.course, {}).empty());
}

TEST(ScatterOf, AHeadingIsShownInDegreesOfOneTurn) {
  Shown shown(400, kDegree_rad);
  for (std::size_t i = 0; i < 400; ++i) shown.course.heading_rad[i] = (i % 2 == 0 ? -30 : 400) * kDegree_rad;
  Innovations after = shown.innovations;
  after.grid *= -2;
  const Scatter seen =
      scatter({"compass.heading", "heading_once", 1, 1, "deg", 0}, shown.innovations, after, shown.course, {});
  EXPECT_EQ(seen.driver, "heading");
  EXPECT_EQ(seen.driver_unit, "deg");
  ASSERT_EQ(seen.driver_value.size(), 200U);
  EXPECT_NEAR(seen.driver_value[0], 330, 1e-9);
  EXPECT_NEAR(seen.driver_value[1], 40, 1e-9);
  EXPECT_NEAR(seen.before[7], 1, 1e-9);
  EXPECT_NEAR(seen.after[7], -2, 1e-9);
}

TEST(ScatterOf, ADriverKeepsItsSignAndABandOfFrequencyIsShownOverTime) {
  Shown shown(400, kDegree_rad);
  shown.course.pitch_rad.assign(400, -10 * kDegree_rad);
  const Scatter pitch = scatter({"compass.heading", "pitch", 1, 1, "deg", 0}, shown.innovations, shown.innovations,
                                shown.course, {});
  EXPECT_EQ(pitch.driver, "pitch");
  ASSERT_FALSE(pitch.driver_value.empty());
  EXPECT_NEAR(pitch.driver_value[0], -10, 1e-9);
  const Scatter slow =
      scatter({"compass.heading", "slow", 1, 1, "deg", 0}, shown.innovations, shown.innovations, shown.course, {});
  EXPECT_EQ(slow.driver, "time");
  EXPECT_EQ(slow.driver_unit, "s");
  ASSERT_EQ(slow.driver_value.size(), 200U);
  EXPECT_NEAR(slow.driver_value[0], 20, 1e-9);
  EXPECT_NEAR(slow.driver_value[199], 39.9, 1e-9);
}

TEST(ScatterOf, ALongMissionIsThinnedAndRowsThatDifferAreNotCompared) {
  const Shown shown(8000, 0.1);
  const WhereEntry where{"compass.heading", "slow", 1, 1, "deg", 0};
  const Scatter thinned = scatter(where, shown.innovations, shown.innovations, shown.course, {});
  EXPECT_GE(thinned.driver_value.size(), 600U);
  EXPECT_LE(thinned.driver_value.size(), 1200U);
  EXPECT_EQ(thinned.before.size(), thinned.driver_value.size());
  Innovations fewer = shown.innovations;
  fewer.grid(4000, heading) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(scatter(where, shown.innovations, fewer, shown.course, {}).driver_value.empty());
}

}  // namespace
}  // namespace navcal::gap
