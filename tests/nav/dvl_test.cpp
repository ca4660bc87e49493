// SPDX-License-Identifier: Apache-2.0
// Velocities over the bottom and through the water: what they are used for, and what is left of them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nav/navigator.h"
#include "tests/nav/drive.h"

namespace navcal::nav::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const auto kAhead = [](double) { return 0.0; };
const auto kCurves = [](double t_s) { return 0.2 * std::sin(t_s / 4); };

/// Fixes for the first 20 s, a current, a shaft that reads 10 % too much, and a DVL.
DriveOptions with_dvl() {
  DriveOptions options;
  options.noise = false;
  options.fixed = [](double t_s) { return t_s < 20; };
  options.current_m_s = {0.1, 0.25};
  options.shaft_share = 1.1;
  options.dvl.emplace();
  return options;
}

Navigator driven(const sim::PathMotion& way, double duration_s, const DriveOptions& options) {
  Navigator navigator({});
  give(navigator, readings_along(way, duration_s, options));
  return navigator;
}

TEST(BottomVelocity, NeitherCurrentNorShaftMatters) {
  const auto way = level_way(200, 1, kCurves);
  const auto options = with_dvl();
  const Navigator navigator = driven(way, 200, options);
  EXPECT_LT(position_error_m(navigator, way, options.current_m_s), 0.3);
  EXPECT_EQ(navigator.estimate().speed_source, SpeedSource::bottom);
  EXPECT_LT(navigator.estimate().position_std_m.maxCoeff(), 17) << "180 s at 1.1 m/s with 5 degrees";
  EXPECT_EQ(navigator.velocity_outliers(), 0U);
  EXPECT_EQ(navigator.left_out(), 0U);
  auto without = options;
  without.dvl.reset();
  EXPECT_GT(position_error_m(driven(way, 200, without), way, options.current_m_s), 3);
}

TEST(BottomVelocity, ASlowLateDvlFollowsTurnsAndChangesOfSpeed) {
  const auto way = reference_way("path_long600");
  for (const double period_s : {0.1, 0.5, 1.0, 2.0}) {
    auto options = with_dvl();
    options.dvl->period_s = period_s;
    options.dvl->latency_s = 0.4;
    const Navigator navigator = driven(way, 500, options);
    EXPECT_LT(position_error_m(navigator, way, options.current_m_s), period_s < 2 ? 1.5 : 3) << period_s;
  }
}

TEST(BottomVelocity, VelocityOverGroundIsTheMeasuredOne) {
  const auto way = level_way(60, 1, kAhead, 0, 1);
  const auto options = with_dvl();
  const auto velocity_m_s = driven(way, 60, options).estimate().velocity_m_s.value();
  EXPECT_NEAR(velocity_m_s.x(), std::cos(1) + 0.1, 0.01);
  EXPECT_NEAR(velocity_m_s.y(), std::sin(1) + 0.25, 0.01);
}

TEST(BottomVelocity, AMinuteWithoutBottomLockGoesOnWithTheSetThatWasFound) {
  // No fix shows the set: the first one comes at the beginning alone.
  const auto way = level_way(200, 1, kAhead, 0, 0.5);
  auto options = with_dvl();
  options.shaft_share = 1;
  options.fixed = [](double t_s) { return t_s < 1; };
  options.dvl->locked = [](double t_s) { return t_s < 60 || t_s > 120; };
  Navigator navigator({});
  double lost_std_m = 0;
  for (const auto& arrived : readings_along(way, 200, options)) {
    give(navigator, arrived.reading);
    const double t_s = since_start_s(arrived.arrival_ns);
    if (t_s < 5) continue;
    const auto estimate = navigator.estimate();
    const bool lost = t_s > 63.5 && t_s < 120;
    if (t_s < 62 || t_s > 120.5 || lost) {
      ASSERT_EQ(estimate.speed_source, lost ? SpeedSource::shaft : SpeedSource::bottom) << t_s;
    }
    if (lost) {
      EXPECT_GE(estimate.position_std_m.norm(), lost_std_m);
      lost_std_m = estimate.position_std_m.norm();
    }
  }
  EXPECT_NEAR(navigator.estimate().set_m_s.x(), 0.1, 0.01);
  EXPECT_NEAR(navigator.estimate().set_m_s.y(), 0.25, 0.01);
  // The current alone would be 16 m.
  EXPECT_LT(position_error_m(navigator, way, options.current_m_s), 2.5);
}

TEST(BottomVelocity, FixesAndBottomLockTogetherLeaveTheSetToTheDvl) {
  const auto way = level_way(120, 1, kCurves);
  auto options = with_dvl();
  options.shaft_share = 1;
  options.fixed = [](double) { return true; };
  const auto set_m_s = driven(way, 120, options).estimate().set_m_s;
  EXPECT_NEAR(set_m_s.x(), 0.1, 0.03);
  EXPECT_NEAR(set_m_s.y(), 0.25, 0.03);
}

TEST(BottomVelocity, BeforeTheFirstFixThereIsNoPositionButASet) {
  const auto way = level_way(60, 1, kAhead);
  auto options = with_dvl();
  options.shaft_share = 1;
  options.fixed = [](double) { return false; };
  Navigator navigator = driven(way, 60, options);
  EXPECT_FALSE(navigator.estimate().position_m);
  EXPECT_NEAR(navigator.estimate().set_m_s.y(), 0.25, 0.02);
  navigator.take(FixReading{navigator.time_ns(), Vector2d(3, 4), 1, {}, 0.1});
  EXPECT_EQ(navigator.estimate().position_m.value(), Vector2d(3, 4));
  EXPECT_NEAR(navigator.estimate().position_std_m.x(), 1, 1e-9) << "ways before it do not count";
}

TEST(BottomVelocity, TheArmOfTheInstrumentIsTakenAway) {
  // It turns on the spot, with the instrument 2 m ahead of the origin.
  const auto way = level_way(100, 0, [](double) { return 0.4; });
  auto options = with_dvl();
  options.current_m_s.setZero();
  options.dvl->position_m = {2, 0.5, 0.3};
  EXPECT_LT(position_error_m(driven(way, 100, options), way), 0.1);
  EXPECT_NEAR(driven(way, 100, options).estimate().velocity_m_s->head<2>().norm(), 0, 0.02);
  options.dvl->frame = VelocityFrame::earth;
  EXPECT_LT(position_error_m(driven(way, 100, options), way), 0.3);
}

TEST(BottomVelocity, InEarthAxesItNeedsNoHeading) {
  const auto way = level_way(200, 1, kCurves);
  auto options = with_dvl();
  options.dvl->frame = VelocityFrame::earth;
  EXPECT_LT(position_error_m(driven(way, 200, options), way, options.current_m_s), 0.5);
  options.compass = false;
  const Navigator navigator = driven(way, 200, options);
  EXPECT_FALSE(navigator.estimate().heading_rad);
  EXPECT_LT(position_error_m(navigator, way, options.current_m_s), 0.5);
  EXPECT_TRUE(navigator.estimate().velocity_m_s);
}

TEST(BottomVelocity, InBodyAxesWithoutAHeadingItMayHaveGoneAnywhere) {
  const auto way = level_way(60, 1, kAhead);
  auto options = with_dvl();
  options.compass = false;
  const auto estimate = driven(way, 60, options).estimate();
  EXPECT_FALSE(estimate.velocity_m_s);
  EXPECT_GT(estimate.position_std_m.x(), 35);
  EXPECT_LT(estimate.position_std_m.x(), 60);
}

TEST(BottomVelocity, BadBeamsAreCountedAndChangeNothing) {
  const auto way = level_way(200, 1, kCurves);
  auto options = with_dvl();
  options.dvl->bad_share = 0.1;
  const Navigator navigator = driven(way, 200, options);
  EXPECT_GT(navigator.velocity_outliers(), 70U);
  EXPECT_LT(navigator.velocity_outliers(), 130U);
  EXPECT_LT(position_error_m(navigator, way, options.current_m_s), 0.6);
}

TEST(BottomVelocity, WorksWithoutGyrosAndWithoutAShaft) {
  const auto way = level_way(120, 1, [](double t_s) { return 0.05 * std::sin(t_s / 10); });
  auto options = with_dvl();
  options.rates = options.shaft = false;
  const Navigator navigator = driven(way, 120, options);
  EXPECT_FALSE(navigator.estimate().speed_m_s);
  EXPECT_LT(position_error_m(navigator, way, options.current_m_s), 1);
}

TEST(WaterVelocity, TakesThePlaceOfTheShaft) {
  const auto way = level_way(200, 1, kCurves);
  auto options = with_dvl();
  options.dvl->bottom = false;
  options.dvl->water = true;
  options.current_m_s.setZero();
  for (const bool shaft : {true, false}) {
    options.shaft = shaft;
    const Navigator navigator = driven(way, 200, options);
    EXPECT_EQ(navigator.estimate().speed_source, SpeedSource::water);
    EXPECT_NEAR(navigator.estimate().speed_m_s.value(), 1, 1e-6);
    EXPECT_LT(position_error_m(navigator, way), 1.5);
  }
}

TEST(WaterVelocity, SwayCounts) {
  Navigator navigator({});
  navigator.take(CompassReading{kStart_ns, 0.0, 0.0, 0.0, true});
  navigator.take(FixReading{kStart_ns + 1, Vector2d::Zero(), 1, {}, 0.1});
  for (int i = 1; i <= 100; ++i) {
    const std::int64_t t_ns = kStart_ns + i * kSecond_ns;
    navigator.take(CompassReading{t_ns, 0.0, 0.0, 0.0, true});
    navigator.take(WaterVelocityReading{t_ns, Vector3d(1, 0.2, 0), VelocityFrame::body, 0.01, Vector3d::Zero()});
  }
  EXPECT_NEAR(navigator.estimate().position_m->x(), 99, 1.1);
  EXPECT_NEAR(navigator.estimate().position_m->y(), 19.8, 0.3);
}

TEST(WaterVelocity, ShowsTheSetBetterThanTheShaft) {
  const auto way = level_way(300, 1, kCurves);
  auto options = with_dvl();
  options.dvl->water = true;
  options.dvl->locked = [](double t_s) { return t_s < 150; };
  const Navigator navigator = driven(way, 300, options);
  EXPECT_EQ(navigator.estimate().speed_source, SpeedSource::water);
  EXPECT_NEAR(navigator.estimate().set_m_s.y(), 0.25, 0.02);
  EXPECT_LT(position_error_m(navigator, way, options.current_m_s), 3);
}

TEST(Depth, OfAGaugeOfItsOwn) {
  Navigator navigator({});
  navigator.take(CompassReading{kStart_ns, 0.0, 0.3, 0.0, true});
  for (int i = 1; i <= 300; ++i)
    navigator.take(DepthReading{kStart_ns + i * (kSecond_ns / 10), 5 + 0.02 * i, Vector3d(1, 0, 0.5)});
  const double below_m = -std::sin(0.3) + 0.5 * std::cos(0.3);
  EXPECT_NEAR(navigator.estimate().depth_m.value(), 11 - below_m, 0.05);
  EXPECT_EQ(navigator.left_out(), 0U);
  navigator.take(DepthReading{navigator.time_ns() + 1, std::numeric_limits<double>::quiet_NaN(), {0, 0, 0}});
  navigator.take(DepthReading{navigator.time_ns() + 2, 1e6, {0, 0, 0}});
  EXPECT_EQ(navigator.left_out(), 2U);
}

TEST(Nonsense, VelocitiesThatNoDvlCanGiveAreLeftOut) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto way = level_way(60, 1, kCurves);
  auto options = with_dvl();
  options.dvl->water = true;
  Navigator clean({}), disturbed({});
  std::uint64_t left_out = 0;
  for (const auto& arrived : readings_along(way, 60, options)) {
    for (const double bad : {kNaN, kInfinite, -kInfinite, 1e300}) {
      const std::int64_t t_ns = arrived.arrival_ns;
      disturbed.take(GroundVelocityReading{t_ns, Vector3d(0, bad, 0), VelocityFrame::body, 0.01, {0, 0, 0}});
      disturbed.take(WaterVelocityReading{t_ns, Vector3d(0, 0, bad), VelocityFrame::earth, 0.01, {0, 0, 0}});
      disturbed.take(GroundVelocityReading{t_ns, Vector3d::Zero(), VelocityFrame::body, bad, {0, 0, 0}});
      left_out += 3;
    }
    for (const double std : {0.0, -0.01, 1.5}) {
      disturbed.take(
          GroundVelocityReading{arrived.arrival_ns, Vector3d::Zero(), VelocityFrame::body, std, {0, 0, 0}});
      ++left_out;
    }
    give(clean, arrived.reading);
    give(disturbed, arrived.reading);
  }
  EXPECT_EQ(disturbed.left_out(), left_out);
  EXPECT_EQ(clean.estimate().position_m, disturbed.estimate().position_m);
  EXPECT_EQ(clean.estimate().position_std_m, disturbed.estimate().position_std_m);
  EXPECT_EQ(clean.estimate().set_m_s, disturbed.estimate().set_m_s);
}

TEST(WithoutADvl, EverythingIsAsItWasBeforeThereWasOne) {
  // Values of the navigator before it knew velocities; bit for bit on one machine, within rounding on others.
  const auto way = reference_way("path_long600");
  DriveOptions options;
  options.fixed = [](double t_s) { return t_s < 15; };
  options.current_m_s = {0.1, -0.05};
  Navigator navigator({});
  give(navigator, readings_along(way, 60, options));
  const auto estimate = navigator.estimate();
  EXPECT_EQ(estimate.speed_source, SpeedSource::shaft);
  constexpr double kRounding = 1e-9;
  EXPECT_NEAR(estimate.position_m->x(), 23.365715482302853, kRounding);
  EXPECT_NEAR(estimate.position_m->y(), -15.084428833879667, kRounding);
  EXPECT_NEAR(estimate.position_std_m.x(), 3.551721068041596, kRounding);
  EXPECT_NEAR(estimate.position_std_m.y(), 3.6933013977590323, kRounding);
  EXPECT_NEAR(estimate.set_m_s.x(), 0.074239453690189861, kRounding);
  EXPECT_NEAR(estimate.set_m_s.y(), -0.030180211175100818, kRounding);
  EXPECT_NEAR(*estimate.heading_rad, 3.4868423145219611, kRounding);
  EXPECT_NEAR(*estimate.depth_m, 0.026315834849440112, kRounding);
  EXPECT_NEAR(navigator.error_radius_m(30).value(), 13.19654102606281, kRounding);
}

}  // namespace
}  // namespace navcal::nav::test
