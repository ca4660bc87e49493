// SPDX-License-Identifier: Apache-2.0
// What other tools accept wrongly, through everything that the daemon runs: motions of a vehicle, its compass's
// field and tilt, and its gyro.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "calib/suite/suite.h"
#include "tests/calib/magnetometer_paths.h"

namespace navcal::calib {
namespace {

using namespace test;

constexpr double kReadingPeriod_s = 0.1;

struct Asked {
  const char* name;
  Instruments instruments;
};

class SuiteRefusal : public testing::TestWithParam<Asked> {
 protected:
  /// A quarter of an hour at most; the gyro is right, and tells the suite so where it turns.
  static Suite run(const std::vector<Attitude>& motion, const Iron& iron) {
    Random random(21);
    SuiteOptions options;
    options.local_field.known = reference_field();
    options.tilt_lag_s = 0;
    Suite suite(options, GetParam().instruments);
    const auto field = field_on(motion, iron, random);
    for (std::size_t i = 0; i < field.size(); ++i) {
      const double time_s = kReadingPeriod_s * static_cast<double>(i);
      if (GetParam().instruments.rate) suite.put(rate_at(motion, i));
      CompassReading reading;
      reading.time_s = time_s;
      reading.roll_rad = field[i].roll_rad;
      reading.pitch_rad = field[i].pitch_rad;
      reading.field_body_uT = field[i].field_body_uT;
      suite.put(reading);
    }
    suite.finish();
    return suite;
  }

  static RateReading rate_at(const std::vector<Attitude>& motion, std::size_t i) {
    const Attitude &before = motion[i == 0 ? 0 : i - 1], &now = motion[i],
                   &after = motion[std::min(i + 1, motion.size() - 1)];
    const double yaw = (after.heading_rad - before.heading_rad) / (2 * kReadingPeriod_s),
                 pitch = (after.pitch_rad - before.pitch_rad) / (2 * kReadingPeriod_s),
                 roll = (after.roll_rad - before.roll_rad) / (2 * kReadingPeriod_s);
    RateReading rate;
    rate.time_s = kReadingPeriod_s * static_cast<double>(i);
    rate.rate_rad_s = {roll - yaw * std::sin(now.pitch_rad),
                       pitch * std::cos(now.roll_rad) + yaw * std::sin(now.roll_rad) * std::cos(now.pitch_rad),
                       yaw * std::cos(now.roll_rad) * std::cos(now.pitch_rad) - pitch * std::sin(now.roll_rad)};
    rate.yaw_rate_b_rad_s = rate.rate_rad_s.z();
    return rate;
  }

  static void expect_refused(const std::vector<Attitude>& motion, const Iron& iron, const std::string& reason) {
    Suite suite = run(motion, iron);
    const Report report = suite.report();
    const auto* magnetometer = report.find(Calibrator::magnetometer);
    ASSERT_NE(magnetometer, nullptr);
    EXPECT_EQ(magnetometer->verdict, Verdict::refused);
    EXPECT_NE(magnetometer->judgement.reason.find(reason), std::string::npos) << magnetometer->judgement.reason;
    EXPECT_FALSE(magnetometer->judgement.manoeuvre.empty());
    EXPECT_FALSE(report.in_force.magnetometer);
    EXPECT_NE(suite.accept(Calibrator::magnetometer), "");
    std::printf("  %s -> %s\n", magnetometer->judgement.reason.c_str(), magnetometer->judgement.manoeuvre.c_str());
  }
};

TEST_P(SuiteRefusal, GliderWhoseHardIronExceedsTheField) {
  Iron iron;
  iron.hard_uT = {45, -30, 25};
  expect_refused(swinging(1800, 720, 15, 20), iron, "exceeds the Earth's field");
}

TEST_P(SuiteRefusal, DiveWithYawWithin120Degrees) {
  expect_refused(swinging(1800, 120, 4, 25), some_iron(), "headings within 1");
}

TEST_P(SuiteRefusal, NoTurnAtAll) { expect_refused(swinging(1200, 0, 5, 5), some_iron(), ""); }

/// Heading is calibrated by it, and nothing is said of the vertical.
TEST_P(SuiteRefusal, APlanarSwingSaysNothingOfTheVertical) {
  Suite suite = run(swinging(1800, 1080, 0, 0), some_iron());
  const auto report = suite.report();
  const auto* magnetometer = report.find(Calibrator::magnetometer);
  EXPECT_TRUE(magnetometer->judgement.accepted) << magnetometer->judgement.reason;
  const auto* vertical = magnetometer->quantity("offset_z_uT");
  EXPECT_TRUE(vertical == nullptr || !std::isfinite(vertical->std)) << vertical->value << " +- " << vertical->std;
}

/// Reasons by which a suite refuses after half a minute of such readings.
template <class Fill>
std::string reason_of(Calibrator calibrator, Fill fill) {
  Suite suite({}, {true, true, true, true});
  for (int i = 0; i < 300; ++i) {
    CompassReading compass;
    RateReading rate;
    compass.time_s = rate.time_s = 0.1 * i;
    compass.heading_rad = 0.02 * i;
    compass.field_body_uT = Eigen::Vector3d(18 * std::cos(0.02 * i), -18 * std::sin(0.02 * i), 40);
    rate.rate_rad_s = {0, 0, 0.2 + 1e-6 * i};
    fill(i, compass, rate);
    suite.put(compass);
    suite.put(rate);
  }
  suite.finish();
  const Report report = suite.report();
  const auto* const found = report.find(calibrator);
  return found == nullptr ? "none" : found->judgement.reason;
}

TEST(SuiteReasons, AreTheTrueOnes) {
  const auto nothing = [](int, CompassReading&, RateReading&) {};
  const auto second = [](int i, CompassReading&, RateReading& rate) { rate.yaw_rate_b_rad_s = 0.2 + 1e-6 * i; };
  const auto frozen = [](int, CompassReading& compass, RateReading&) {
    compass.heading_rad = 1;
    compass.field_body_uT = Eigen::Vector3d(18, 0, 40);
  };
  EXPECT_EQ(reason_of(Calibrator::gyro_b, nothing), "no reading of a second yaw gyro so far");
  EXPECT_EQ(reason_of(Calibrator::gyro_b, second).find("no reading"), std::string::npos);
  EXPECT_EQ(reason_of(Calibrator::gps_compass, nothing), "no fix with a speed over ground so far");
  for (const Calibrator calibrator : {Calibrator::gyro, Calibrator::compass, Calibrator::magnetometer}) {
    EXPECT_NE(reason_of(calibrator, frozen).find("stay the same to the last digit"), std::string::npos);
    EXPECT_EQ(reason_of(calibrator, nothing).find("stay the same"), std::string::npos);
  }
}

TEST(FieldStepWords, AStepOfNoKnownSizeIsNoFact) {
  FieldStep step;
  step.size_uT = {0.5, 0.1, 0.31};
  EXPECT_EQ(words_of(step).find("the field may have stepped by (0.50"), 0U) << words_of(step);
  step.std_uT = {8.9, 11.2, 0.94};
  EXPECT_EQ(words_of(step).find("the field may have stepped by (0.50"), 0U) << words_of(step);
  step.std_uT = {0.1, 11.2, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(words_of(step).find("the field stepped by (0.50"), 0U) << words_of(step);
}

TEST(SuiteOfLargeFields, SaysThatTheFieldIsTooLarge) {
  Suite suite({}, {.compass = true});
  for (int i = 0; i < 300; ++i) {
    CompassReading reading;
    reading.time_s = 0.1 * i;
    reading.heading_rad = 0.02 * i;
    reading.field_body_uT = Eigen::Vector3d(18 * std::cos(0.02 * i), -18 * std::sin(0.02 * i), 840 + i % 7);
    suite.put(reading);
  }
  suite.finish();
  const Report report = suite.report();
  const auto* const magnetometer = report.find(Calibrator::magnetometer);
  ASSERT_NE(magnetometer, nullptr);
  EXPECT_EQ(magnetometer->verdict, Verdict::refused);
  EXPECT_NE(magnetometer->judgement.reason.find("larger than the 500 uT"), std::string::npos)
      << magnetometer->judgement.reason;
}

INSTANTIATE_TEST_SUITE_P(Instruments, SuiteRefusal,
                         testing::Values(Asked{"compass", {true, false, false, false}},
                                         Asked{"compass_and_gyro", {true, true, false, false}}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace navcal::calib
