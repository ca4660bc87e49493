// SPDX-License-Identifier: Apache-2.0
// Attitude, speed and time: what holds of any way.
#include "nav/navigator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "tests/nav/drive.h"

namespace navcal::nav::test {
namespace {

DriveOptions without_noise() {
  DriveOptions options;
  options.noise = false;
  return options;
}

const auto kStraight = [](double) { return 0.0; };

TEST(Navigator, SaysNothingBeforeItWasTold) {
  const Navigator navigator({});
  EXPECT_FALSE(navigator.started());
  const auto estimate = navigator.estimate();
  EXPECT_FALSE(estimate.heading_rad);
  EXPECT_FALSE(estimate.pitch_rad);
  EXPECT_FALSE(estimate.depth_m);
  EXPECT_FALSE(estimate.speed_m_s);
  EXPECT_FALSE(estimate.velocity_m_s);
  EXPECT_FALSE(estimate.position_m);
}

TEST(Navigator, AVehicleThatLiesStillStaysWhereItIs) {
  const auto way = level_way(600, 0, kStraight, 1.5, 2);
  auto options = without_noise();
  options.fixed = [](double t_s) { return t_s < 20; };
  const auto readings = readings_along(way, 600, options);
  Navigator navigator({});
  double std_m = 0;
  for (const auto& arrived : readings) {
    give(navigator, arrived.reading);
    const auto estimate = navigator.estimate();
    if (since_start_s(arrived.arrival_ns) < 21) continue;
    EXPECT_GE(estimate.position_std_m.x(), std_m) << "without fixes nothing gets better";
    std_m = estimate.position_std_m.x();
  }
  EXPECT_LT(position_error_m(navigator, way), 1e-6);
  EXPECT_NEAR(heading_error_rad(navigator, way), 0, 1e-9);
  const auto estimate = navigator.estimate();
  EXPECT_NEAR(estimate.depth_m.value(), 1.5, 1e-9);
  EXPECT_NEAR(estimate.velocity_m_s.value().norm(), 0, 1e-9);
  EXPECT_NEAR(estimate.since_fix_s, 581, 0.1);
  EXPECT_EQ(estimate.since_fix_m, 0);
}

TEST(Navigator, TheTiltOfAnInertialUnitDoesNotLag) {
  for (const bool lags : {false, true}) {
    Navigator navigator({});
    for (std::int64_t i = 0; i < 400; ++i) {
      const std::int64_t t_ns = kStart_ns + i * (kSecond_ns / 20);
      const double true_rad = 0.002 * static_cast<double>(i);
      navigator.take(RateReading{t_ns, Eigen::Vector3d(0.04, 0, 0), 0});
      navigator.take(CompassReading{t_ns, 0.0, 0.0, true_rad - (lags ? 0.012 : 0), false, lags});
      if (i > 200) {
        ASSERT_NEAR(navigator.estimate().roll_rad.value(), true_rad, 1e-3) << lags;
      }
    }
  }
}

TEST(Navigator, GoesRoundAndRoundWithoutAJumpAtNorthOrSouth) {
  const auto way = level_way(200, 1, [](double) { return -0.5; });
  Navigator navigator({});
  double before_rad = NAN;
  for (const auto& arrived : readings_along(way, 200, without_noise())) {
    give(navigator, arrived.reading);
    const auto estimate = navigator.estimate();
    if (!estimate.heading_rad) continue;
    ASSERT_GE(*estimate.heading_rad, 0);
    ASSERT_LT(*estimate.heading_rad, 2 * std::numbers::pi);
    if (std::isfinite(before_rad)) {
      ASSERT_LT(std::abs(base::wrapped(*estimate.heading_rad - before_rad)), 0.03);
    }
    before_rad = *estimate.heading_rad;
    ASSERT_NEAR(heading_error_rad(navigator, way), 0, 0.1 * kDegree);
  }
  EXPECT_LT(position_error_m(navigator, way), 0.1);
}

TEST(Navigator, LateReadingsAreComparedWithTheirOwnTime) {
  // At 40 deg/s a heading that is 66 ms old is off by 2.6 degrees, and a fix of half a second ago by half a metre.
  const auto way = level_way(120, 1, [](double) { return 40 * kDegree; });
  auto options = without_noise();
  Navigator late({});
  give(late, readings_along(way, 120, options));
  options.late = false;
  Navigator prompt({});
  give(prompt, readings_along(way, 120, options));
  EXPECT_NEAR(heading_error_rad(late, way), 0, 0.05 * kDegree);
  EXPECT_NEAR(heading_error_rad(prompt, way), 0, 0.05 * kDegree);
  EXPECT_LT(position_error_m(late, way), 0.03);
  EXPECT_LT(position_error_m(prompt, way), 0.03);
}

TEST(Navigator, LearnsTheZerosOfItsGyros) {
  const auto way = level_way(900, 1, [](double t_s) { return 0.2 * std::sin(t_s / 10); });
  auto options = without_noise();
  options.zero_rad_s = Eigen::Vector3d(0.3, -0.3, 0.3) * kDegree;
  const auto readings = readings_along(way, 900, options);
  Navigator navigator({});
  give(navigator, readings, 60);
  // Without an integral it would stay at 0.3 deg/s over 0.2/s: 1.5 degrees.
  EXPECT_LT(std::abs(heading_error_rad(navigator, way)), 1.5 * kDegree);
  navigator = Navigator({});
  give(navigator, readings);
  EXPECT_NEAR(heading_error_rad(navigator, way), 0, 0.05 * kDegree);
  EXPECT_NEAR(navigator.estimate().roll_rad.value(), 0, 0.05 * kDegree);
  EXPECT_NEAR(navigator.estimate().pitch_rad.value(), 0, 0.05 * kDegree);
}

TEST(Navigator, SmoothsTheNoiseOfTheCompass) {
  const auto way = level_way(300, 1, kStraight);
  Navigator navigator({});
  double square = 0;
  int count = 0;
  for (const auto& arrived : readings_along(way, 300, {})) {
    give(navigator, arrived.reading);
    if (since_start_s(arrived.arrival_ns) < 100) continue;
    square += std::pow(heading_error_rad(navigator, way), 2);
    ++count;
  }
  // White noise of s through a gain of g a reading leaves s sqrt(g/2): a tenth at 0.02; the gyros' noise adds to
  // it.
  EXPECT_LT(std::sqrt(square / count), 0.2 * 0.5 * kDegree);
}

TEST(Navigator, SpeedFollowsTheShaft) {
  Navigator navigator({});
  for (std::int64_t i = 0; i <= 200; ++i) {
    const std::int64_t t_ns = kStart_ns + i * 50'000'000;
    navigator.take(ShaftReading{t_ns - 5'000'000, i < 100 ? 0.0 : 10.0});
    navigator.take(RateReading{t_ns, Eigen::Vector3d::Zero(), 0});
    if (i == 99) {
      EXPECT_EQ(navigator.estimate().speed_m_s, 0);
    }
    // One time constant after the step: 1 - 1/e of it.
    if (i == 117) {
      EXPECT_NEAR(*navigator.estimate().speed_m_s, 0.872 * (1 - std::exp(-1)), 0.02);
    }
  }
  EXPECT_NEAR(*navigator.estimate().speed_m_s, 0.872, 0.01);
}

TEST(Navigator, APropellerThatTurnsBackwardsGivesNothing) {
  Navigator navigator({});
  for (std::int64_t i = 0; i <= 200; ++i) {
    navigator.take(ShaftReading{kStart_ns + i * 50'000'000, -10});
    navigator.take(RateReading{kStart_ns + i * 50'000'000, Eigen::Vector3d::Zero(), 0});
  }
  EXPECT_EQ(navigator.estimate().speed_m_s, 0);
}

// An autopilot sends the tilt twenty times a second, and the field, from which the heading is made, sixty
// milliseconds late.
TEST(Navigator, ATiltMakesNoHeadingOldThatWasMeasuredBeforeIt) {
  Navigator navigator({});
  for (std::int64_t i = 0; i < 400; ++i) {
    const std::int64_t t_ns = kStart_ns + i * (kSecond_ns / 20);
    navigator.take(RateReading{t_ns, Eigen::Vector3d::Zero(), 0});
    navigator.take(CompassReading{t_ns, std::nullopt, 0.0, 0.1, false, false});
    if (i % 2 == 1) navigator.take(CompassReading{t_ns - 60'000'000, 1.0, 0.0, 0.3, true, false});
  }
  EXPECT_NEAR(navigator.estimate().heading_rad.value_or(9), 1, 1e-6);
  EXPECT_NEAR(navigator.estimate().heading_std_rad, 0.0175, 0.001);
  EXPECT_NEAR(navigator.estimate().roll_rad.value_or(9), 0.1, 0.01) << "an older tilt is left out";
}

TEST(Navigator, AHullThatFloatsWithItsTailDownIsNotAboveTheWater) {
  for (const double gauge_m : {0.0, -0.05, 3.0}) {
    Navigator navigator({});
    for (std::int64_t i = 0; i < 200; ++i) {
      const std::int64_t t_ns = kStart_ns + i * (kSecond_ns / 10);
      navigator.take(RateReading{t_ns, Eigen::Vector3d::Zero(), std::nullopt});
      navigator.take(CompassReading{t_ns, 1.0, std::numbers::pi / 3, 0.0, true, false});
      navigator.take(DepthReading{t_ns, gauge_m, {-1, 0, 0}, 0.05});
    }
    // The gauge is 0.87 m below the origin; at the surface it was set to zero, or hangs in the air.
    const double lever_m = std::sin(std::numbers::pi / 3);
    const bool floats = gauge_m < lever_m;
    EXPECT_NEAR(navigator.estimate().depth_m.value(), floats ? gauge_m : gauge_m - lever_m, 0.01);
    EXPECT_NEAR(navigator.estimate().depth_std_m.value(), floats ? std::hypot(0.05, lever_m) : 0.05, 0.02);
  }
}

TEST(Navigator, AHeadingIsNoBetterThanItsDeviceStates) {
  for (const auto& [device_rad, stated_rad] :
       {std::pair(0.17, 0.17), std::pair(0.01, 5 * std::numbers::pi / 180)}) {
    Navigator navigator({});
    navigator.take(RateReading{kStart_ns, Eigen::Vector3d::Zero(), 0});
    navigator.take(CompassReading{kStart_ns, 1.0, 0.0, 0.0, false, false, device_rad});
    EXPECT_NEAR(navigator.estimate().heading_std_rad, stated_rad, 1e-6);
    navigator.take(CompassReading{kStart_ns + kSecond_ns, 1.0, 0.0, 0.0, true, false, device_rad});
    EXPECT_NEAR(navigator.estimate().heading_std_rad, std::numbers::pi / 180, 1e-3) << "calibrated";
  }
}

TEST(Navigator, TheSameReadingsGiveTheSameBits) {
  const auto way = reference_way("path5");
  const auto readings = readings_along(way, 50, {});
  Navigator one({}), other({});
  give(one, readings);
  give(other, readings);
  const auto a = one.estimate(), b = other.estimate();
  EXPECT_EQ(a.time_ns, b.time_ns);
  EXPECT_EQ(a.heading_rad, b.heading_rad);
  EXPECT_EQ(a.position_m, b.position_m);
  EXPECT_EQ(a.position_std_m, b.position_std_m);
  EXPECT_EQ(a.velocity_m_s, b.velocity_m_s);
  EXPECT_EQ(a.depth_m, b.depth_m);
}

}  // namespace
}  // namespace navcal::nav::test
