// SPDX-License-Identifier: Apache-2.0
// Instruments that are not there, fall silent, repeat themselves or talk nonsense.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nav/navigator.h"
#include "tests/nav/drive.h"

namespace navcal::nav::test {
namespace {

DriveOptions quiet() {
  DriveOptions options;
  options.noise = false;
  return options;
}

sim::PathMotion turning() {
  return level_way(120, 1, [](double t_s) { return t_s < 60 ? 0.0 : 0.3; });
}

TEST(MissingInstruments, WithoutGyrosTheHeadingIsTheCompasss) {
  const auto way = turning();
  auto options = quiet();
  options.rates = false;
  Navigator navigator({});
  give(navigator, readings_along(way, 120, options));
  // The shaft is heard of 50 ms after the last heading is: so long the turn goes on unseen.
  EXPECT_NEAR(heading_error_rad(navigator, way), 0, 0.1 * 0.3 + 0.001);
  EXPECT_FALSE(navigator.estimate().depth_m);
  EXPECT_LT(position_error_m(navigator, way), 0.2);
}

TEST(MissingInstruments, WithoutACompassThereIsNoHeadingAndNoWay) {
  const auto way = turning();
  auto options = quiet();
  options.compass = false;
  options.fixed = [](double t_s) { return t_s < 30; };
  Navigator navigator({});
  give(navigator, readings_along(way, 60, options));
  const auto estimate = navigator.estimate();
  EXPECT_FALSE(estimate.heading_rad);
  EXPECT_FALSE(estimate.pitch_rad);
  EXPECT_FALSE(estimate.velocity_m_s);
  EXPECT_NEAR(*estimate.speed_m_s, 1, 1e-3);
  EXPECT_GT(estimate.position_std_m.x(), 30) << "it may have gone anywhere";
  EXPECT_NEAR(*estimate.depth_m, 0, 1e-9);
}

TEST(MissingInstruments, WithoutTheShaftThePositionIsHeldAndTheErrorSaysHowFarItMayBe) {
  const auto way = turning();
  auto options = quiet();
  options.shaft = false;
  options.fixed = [](double t_s) { return t_s < 30; };
  Navigator navigator({});
  give(navigator, readings_along(way, 60, options));
  const auto estimate = navigator.estimate();
  EXPECT_FALSE(estimate.speed_m_s);
  EXPECT_FALSE(estimate.velocity_m_s);
  EXPECT_GT(estimate.position_std_m.x(), 30);
  EXPECT_LT(position_error_m(navigator, way), 3 * estimate.position_std_m.norm());
}

TEST(MissingInstruments, WithFixesAloneThePositionIsThatOfTheFixes) {
  const auto way = level_way(60, 0, [](double) { return 0.0; });
  auto options = quiet();
  options.rates = options.compass = options.shaft = false;
  Navigator navigator({});
  give(navigator, readings_along(way, 60, options));
  EXPECT_LT(position_error_m(navigator, way), 1e-9);
  EXPECT_LT(navigator.estimate().since_fix_s, 1e-9);
}

TEST(MissingInstruments, ACompassWithoutInclinometerLeavesTheVehicleLevel) {
  Navigator navigator({});
  for (std::int64_t i = 0; i < 2000; ++i) {
    const std::int64_t t_ns = kStart_ns + i * 50'000'000;
    navigator.take(RateReading{t_ns, Eigen::Vector3d(0.01, -0.01, 0), 0});
    if (i % 2 == 0) navigator.take(CompassReading{t_ns, 1.0, {}, {}, false});
  }
  EXPECT_NEAR(*navigator.estimate().heading_rad, 1, 1e-6);
  EXPECT_FALSE(navigator.estimate().pitch_rad);
}

TEST(Gaps, AfterAPauseOfTheGyrosTheNextHeadingIsTakenAsItIs) {
  const auto way = level_way(120, 1, [](double) { return 0.3; });
  Navigator navigator({});
  for (const auto& arrived : readings_along(way, 120, quiet())) {
    const double t_s = since_start_s(arrived.arrival_ns);
    const bool silent = t_s > 60 && t_s < 65;
    if (silent && !std::holds_alternative<FixReading>(arrived.reading)) continue;
    give(navigator, arrived.reading);
    if (t_s > 65.4) {
      ASSERT_NEAR(heading_error_rad(navigator, way), 0, 0.02) << t_s;
    }
  }
}

TEST(Gaps, ALostFrameDoesNotMatter) {
  const auto way = level_way(120, 1, [](double t_s) { return 0.3 * std::sin(t_s); });
  Navigator navigator({});
  int i = 0;
  for (const auto& arrived : readings_along(way, 120, quiet())) {
    if (++i % 7 != 0) give(navigator, arrived.reading);
  }
  EXPECT_NEAR(heading_error_rad(navigator, way), 0, 0.2 * kDegree);
}

TEST(Gaps, AShaftThatIsNotHeardOfMayHaveStopped) {
  const auto way = level_way(60, 1, [](double) { return 0.0; });
  Navigator navigator({});
  for (const auto& arrived : readings_along(way, 60, quiet())) {
    const double t_s = since_start_s(arrived.arrival_ns);
    if (std::holds_alternative<ShaftReading>(arrived.reading) && t_s > 30) continue;
    give(navigator, arrived.reading);
    if (t_s > 30.1 && t_s < 31.9) {
      ASSERT_TRUE(navigator.estimate().speed_m_s) << t_s;
    }
    if (t_s > 32.1) {
      ASSERT_FALSE(navigator.estimate().speed_m_s) << t_s;
    }
  }
}

TEST(Nonsense, ReadingsThatNoInstrumentCanGiveAreLeftOut) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto way = turning();
  const auto readings = readings_along(way, 120, {});
  Navigator clean({}), disturbed({});
  std::uint64_t left_out = 0;
  for (const auto& arrived : readings) {
    const std::int64_t t_ns = arrived.arrival_ns;
    for (const double bad : {kNaN, kInfinite, -kInfinite, 1e300}) {
      disturbed.take(RateReading{t_ns, Eigen::Vector3d(0, bad, 0), 1});
      disturbed.take(RateReading{t_ns, Eigen::Vector3d::Zero(), bad});
      disturbed.take(CompassReading{t_ns, bad, 0.0, 0.0, true});
      disturbed.take(CompassReading{t_ns, 1.0, bad, 0.0, true});
      disturbed.take(CompassReading{t_ns, 1.0, 0.0, bad, true});
      disturbed.take(ShaftReading{t_ns, bad});
      disturbed.take(FixReading{t_ns, Eigen::Vector2d(0, bad), 1, {}, 0.1});
      disturbed.take(FixReading{t_ns, Eigen::Vector2d::Zero(), 1, Eigen::Vector2d(bad, 0), 0.1});
      left_out += 8;
    }
    disturbed.take(FixReading{t_ns, Eigen::Vector2d::Zero(), 0, {}, 0.1});
    ++left_out;
    give(clean, arrived.reading);
    give(disturbed, arrived.reading);
  }
  EXPECT_EQ(clean.left_out(), 0U);
  EXPECT_EQ(disturbed.left_out(), left_out);
  EXPECT_EQ(clean.estimate().position_m, disturbed.estimate().position_m);
  EXPECT_EQ(clean.estimate().heading_rad, disturbed.estimate().heading_rad);
}

TEST(Nonsense, WhatIsSaidTwiceOrTooLateCountsOnce) {
  const auto way = turning();
  const auto readings = readings_along(way, 60, {});
  Navigator once({}), twice({});
  for (std::size_t i = 0; i < readings.size(); ++i) {
    give(once, readings[i].reading);
    give(twice, readings[i].reading);
    give(twice, readings[i].reading);
    if (i >= 100) give(twice, readings[i - 100].reading);
  }
  EXPECT_EQ(twice.left_out(), 2 * readings.size() - 100);
  EXPECT_EQ(once.estimate().position_m, twice.estimate().position_m);
  EXPECT_EQ(once.estimate().heading_rad, twice.estimate().heading_rad);
  EXPECT_EQ(once.estimate().depth_m, twice.estimate().depth_m);
}

}  // namespace
}  // namespace navcal::nav::test
