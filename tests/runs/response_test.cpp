// SPDX-License-Identifier: Apache-2.0
#include "runs/response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/runs/four_thrusters.h"

namespace navcal::runs {
namespace {

constexpr RunClock kRunClock{20, 1100};

test::Trait quiet_vehicle() {
  test::Trait trait;
  trait.noise = 0.05;
  return trait;
}

/// Neither command nor battery may tell one session from another: only the vehicle's answer to them counts.
TEST(Response, IsThatOfTheVehicleWhateverIsCommanded) {
  const Response at_once = response_of(test::make_run(quiet_vehicle(), 1), kRunClock);
  test::Trait other = quiet_vehicle();
  other.command_us = 1220;
  other.battery_V = 11.5;
  const Response more = response_of(test::make_run(other, 1), kRunClock);
  for (const Parameter i : {kHeaveEarly, kHeaveLater, kRollTrim, kPitchTrim, kYawRateLate, kDepthZero}) {
    const auto& parameter = kParameters[i];
    EXPECT_NEAR(at_once.parameters[i], more.parameters[i], parameter.tolerance) << parameter.name;
  }
}

TEST(Response, OfAHeavierVehicleIsADeeperDive) {
  test::Trait heavy = quiet_vehicle();
  heavy.weight_share = 0.3;
  const Response nominal = response_of(test::make_run(quiet_vehicle(), 1), kRunClock);
  const Response found = response_of(test::make_run(heavy, 1), kRunClock);
  EXPECT_NEAR(found.parameters[kHeaveEarly] - nominal.parameters[kHeaveEarly], std::log(1.3), 0.06);
  EXPECT_NEAR(found.parameters[kHeaveLater] - nominal.parameters[kHeaveLater], std::log(1.3), 0.06);
}

TEST(Response, ShowsTheZeroOfTheDepthSensor) {
  test::Trait shifted = quiet_vehicle();
  shifted.depth_zero_m = -0.2;
  const Response found = response_of(test::make_run(shifted, 1), kRunClock);
  EXPECT_NEAR(found.parameters[kDepthZero], -0.2, 0.005);
  const Response nominal = response_of(test::make_run(quiet_vehicle(), 1), kRunClock);
  EXPECT_NEAR(found.parameters[kHeaveEarly], nominal.parameters[kHeaveEarly], 0.03);
}

TEST(Response, ShowsALineInTheBandOfARipple) {
  test::Trait rippled = quiet_vehicle();
  rippled.ripple_rad_s = 0.1;
  const Response found = response_of(test::make_run(rippled, 1), kRunClock);
  ASSERT_TRUE(found.spectrum_dB);
  Eigen::Index highest = 0;
  found.spectrum_dB->maxCoeff(&highest);
  EXPECT_NEAR(band_centre_Hz(highest), 4.1, kBandWidth_Hz);
}

TEST(Response, OfARunWithoutThrustIsNone) {
  test::Trait idle = quiet_vehicle();
  idle.command_us = 1100;
  const Response found = response_of(test::make_run(idle, 1), kRunClock);
  EXPECT_FALSE(found.driven);
  EXPECT_FALSE(found.spectrum_dB);
}

TEST(Response, LacksWhatAShortRunDoesNotShow) {
  test::Trait brief = quiet_vehicle();
  brief.seconds = 6;
  const Response found = response_of(test::make_run(brief, 1), kRunClock);
  EXPECT_TRUE(std::isfinite(found.parameters[kHeaveEarly]));
  EXPECT_TRUE(std::isnan(found.parameters[kSinkLate]));
  EXPECT_TRUE(std::isnan(found.parameters[kYawRateLate]));
}

TEST(Bands, EndAtHalfTheRowRate) {
  EXPECT_EQ(bands_at(20), 33);
  EXPECT_EQ(bands_at(10), 14);
  EXPECT_EQ(bands_at(1), 0);
}

}  // namespace
}  // namespace navcal::runs
