// SPDX-License-Identifier: Apache-2.0
// A magnet that comes and goes while a calibration is in force.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "tests/calib/magnetometer_paths.h"
#include "tests/calib/suite/suite_drive.h"

namespace navcal::calib {
namespace {

using namespace test;

/// A vehicle that turns at 0.15 to 0.65 rad/s, with the roll and pitch of a hull in waves.
class SuiteField : public ::testing::Test {
 protected:
  static constexpr double kInterval_s = 0.1;
  static constexpr int kToTell = 160;  ///< readings until the size of a step is known, with the delay of the gate

  explicit SuiteField(bool automatic = true) : suite_(options(automatic), {true, true, false, false}) {}

  /// Root-mean-square error of the heading by the calibration in force, degrees, after the first kToTell readings.
  double turn(int readings, const Eigen::Vector3d& hard_uT) {
    std::vector<Attitude> motion;
    for (int i = 0; i < readings; ++i) {
      const int k = count_ + i;
      motion.push_back(
          {0.04 * k + 1.5 * std::sin(0.017 * k), 0.1 * std::sin(0.21 * k), 0.08 * std::sin(0.13 * k)});
    }
    Iron iron;
    iron.hard_uT = hard_uT;
    double squares = 0;
    int i = 0;
    for (const FieldReading& field : field_on(motion, iron, random_)) {
      CompassReading reading;
      reading.time_s = kInterval_s * ++count_;
      reading.field_body_uT = field.field_body_uT;
      reading.roll_rad = field.roll_rad;
      reading.pitch_rad = field.pitch_rad;
      reading.heading_rad = levelled_heading(field.field_body_uT, field.roll_rad, field.pitch_rad);
      const double rate_rad_s = (0.04 + 1.5 * 0.017 * std::cos(0.017 * (count_ - 1))) / kInterval_s;
      suite_.put(RateReading{reading.time_s, {0, 0, rate_rad_s + 0.002 * normal_(random_)}, {}, {}});
      suite_.put(reading);
      const double error_rad = std::remainder(
          *best_heading(suite_.in_force().correction(), reading) - motion[static_cast<std::size_t>(i)].heading_rad,
          2 * std::numbers::pi);
      if (++i > kToTell) squares += error_rad * error_rad;
    }
    return std::sqrt(squares / (readings - kToTell)) * base::kDegreesPerRadian;
  }
  static SuiteOptions options(bool automatic) {
    SuiteOptions options = thesis_options();
    options.automatic = automatic;
    return options;
  }

  const Eigen::Vector3d vehicle_uT_{3, -2, 1}, magnet_uT_{9, -7, 8};
  Random random_{7};
  std::normal_distribution<double> normal_;
  int count_ = 0;
  Suite suite_;
};

class SuiteFieldByOrder : public SuiteField {
 protected:
  SuiteFieldByOrder() : SuiteField(false) {}
};

TEST_F(SuiteField, TheCalibrationInForceIsMovedByTheStepAndBack) {
  turn(1200, vehicle_uT_);
  ASSERT_TRUE(suite_.in_force().correction().magnetometer);
  const auto name = suite_.in_force().name();
  EXPECT_LT(turn(400, vehicle_uT_ + magnet_uT_), 3);
  EXPECT_NE(suite_.in_force().name(), name);
  EXPECT_GT(suite_.field_error_rad(), 0);
  EXPECT_LT(suite_.field_error_rad(), 0.05);
  EXPECT_LT(turn(400, vehicle_uT_), 3);
  EXPECT_LT((suite_.in_force().correction().magnetometer->offset_uT - vehicle_uT_).head<2>().norm(), 1);
}

TEST_F(SuiteField, ARollBackFindsTheCalibrationMovedToo) {
  turn(1200, vehicle_uT_);
  ASSERT_TRUE(suite_.in_force().correction().magnetometer);
  ASSERT_EQ(suite_.accept(Calibrator::magnetometer), "");
  turn(200, vehicle_uT_ + magnet_uT_);
  ASSERT_EQ(suite_.roll_back(Calibrator::magnetometer), "");
  const auto& in_force = suite_.in_force().correction().magnetometer;
  ASSERT_TRUE(in_force);
  EXPECT_LT((in_force->offset_uT - vehicle_uT_ - magnet_uT_).head<2>().norm(), 1);
}

TEST_F(SuiteFieldByOrder, ADeviationLeavesForceAndWhatWasLearnedBeforeDoesNotCount) {
  turn(1200, vehicle_uT_);
  ASSERT_EQ(suite_.accept(Calibrator::compass), "");
  const double before_deg = turn(200, vehicle_uT_);
  EXPECT_LT(before_deg, 5);
  EXPECT_EQ(suite_.field_error_rad(), 0);
  turn(200, vehicle_uT_ + magnet_uT_);
  EXPECT_FALSE(suite_.in_force().correction().compass);
  // Nothing in force contains the magnet: the heading is off by up to 11 of 19 uT.
  EXPECT_NEAR(suite_.field_error_rad(), magnet_uT_.head<2>().norm() / 15, 0.05);
  const Report report = suite_.report();
  EXPECT_LT(report.find(Calibrator::compass)->judgement.samples, 200U);
  EXPECT_EQ(report.find(Calibrator::compass)->judgement.held_out_quantity, HeldOutQuantity::none);
  EXPECT_EQ(report.find(Calibrator::magnetometer)->judgement.held_out_quantity, HeldOutQuantity::none);
}

TEST_F(SuiteField, RestoredAfterAStepItGoesOnBitForBit) {
  turn(1200, vehicle_uT_);
  turn(60, vehicle_uT_ + magnet_uT_);
  const std::string state = saved(suite_);
  Suite restored(options(true), {true, true, false, false});
  Archive archive{std::string_view(state)};
  restored.archive(archive);
  ASSERT_TRUE(archive.ok() && archive.at_end());
  EXPECT_EQ(saved(restored), state);
}

TEST_F(SuiteField, AStateOfTheLastVersionWithoutStepsToFollowIsRead) {
  turn(1200, vehicle_uT_);
  std::string state = saved(suite_);
  const auto tag = state.find("suite 6");
  ASSERT_NE(tag, std::string::npos);
  state.replace(tag, 7, "suite 4");
  state.resize(state.size() - (2 * sizeof(std::uint64_t) + 3 * sizeof(double) + 1));
  Suite restored(options(true), {true, true, false, false});
  Archive archive{std::string_view(state)};
  restored.archive(archive);
  ASSERT_TRUE(archive.ok() && archive.at_end());
  EXPECT_EQ(saved(restored), saved(suite_));
}

}  // namespace
}  // namespace navcal::calib
