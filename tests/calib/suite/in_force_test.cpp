// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/in_force.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace navcal::calib {
namespace {

Correction gyro(double scale) {
  Correction correction;
  correction.gyro = RateCorrection{scale, 0};
  return correction;
}

TEST(InForce, EveryChangeHasANameOfItsOwn) {
  InForce in_force;
  EXPECT_EQ(in_force.name().text(), "none");
  in_force.adopt(Calibrator::gyro, gyro(1.1));
  const CorrectionName first = in_force.name();
  EXPECT_EQ(first.number, 1U);
  in_force.adopt(Calibrator::gyro, gyro(1.2));
  EXPECT_EQ(in_force.name().number, 2U);
  EXPECT_NE(in_force.name().sum, first.sum);
  InForce other;
  other.adopt(Calibrator::gyro, gyro(1.1));
  EXPECT_EQ(other.name(), first) << "the sum is of the content alone";
}

// The sum stands in logs, so it is the same in every release: FNV-1a, 32 bits, of the archived content.
TEST(InForce, TheSumIsThatOfFowlerNollAndVo) {
  InForce in_force;
  in_force.adopt(Calibrator::gyro, gyro(1.1));
  Correction content = in_force.correction();
  Archive archive;
  archive(content);
  std::uint64_t sum = 0x811c9dc5;
  for (const char c : archive.bytes()) sum = (sum ^ static_cast<std::uint8_t>(c)) * 0x01000193 % 0x100000000;
  EXPECT_EQ(in_force.name().sum, sum);
}

TEST(InForce, RollsBackStepByStepAndOneCalibratorOnly) {
  InForce in_force;
  Correction both = gyro(1.1);
  both.misalignment_rad = 0.05;
  in_force.adopt(Calibrator::gyro, both);
  in_force.adopt(Calibrator::misalignment, both);
  in_force.adopt(Calibrator::gyro, gyro(1.2));
  EXPECT_EQ(in_force.steps_back(Calibrator::gyro), 2U);
  ASSERT_TRUE(in_force.roll_back(Calibrator::gyro));
  EXPECT_EQ(in_force.correction().gyro->scale, 1.1);
  EXPECT_TRUE(in_force.correction().misalignment_rad);
  ASSERT_TRUE(in_force.roll_back(Calibrator::gyro));
  EXPECT_FALSE(in_force.correction().gyro);
  EXPECT_FALSE(in_force.roll_back(Calibrator::gyro));
  EXPECT_EQ(in_force.name().number, 5U) << "the way back is a change, too";
}

TEST(InForce, TheWayBackIsBounded) {
  InForce in_force;
  for (int i = 0; i < 100; ++i) in_force.adopt(Calibrator::gyro, gyro(1 + i * 0.01));
  EXPECT_EQ(in_force.steps_back(Calibrator::gyro), InForce::kDepth);
}

TEST(InForce, SavedAndRestoredItIsTheSame) {
  InForce in_force;
  in_force.adopt(Calibrator::gyro, gyro(1.1));
  in_force.adopt(Calibrator::gyro, gyro(1.2));
  Archive saving;
  in_force.archive(saving);
  InForce back;
  Archive restoring{std::string_view(saving.bytes())};
  back.archive(restoring);
  EXPECT_TRUE(restoring.ok() && restoring.at_end());
  EXPECT_EQ(back.name(), in_force.name());
  EXPECT_TRUE(back.roll_back(Calibrator::gyro));
  EXPECT_EQ(back.correction().gyro->scale, 1.1);
}

TEST(Correction, AHeadingIsCorrectedOnceNeverTwice) {
  CompassReading reading;
  reading.heading_rad = 1.0;
  Correction correction;
  EXPECT_FALSE(corrected_heading(correction, reading));
  EXPECT_EQ(best_heading(correction, reading), 1.0);
  correction.compass = DeviationCorrection{{0, 0.1, 0, 0, 0}};
  EXPECT_NEAR(*corrected_heading(correction, reading), 1.0 - 0.1 * std::sin(1.0), 1e-12);
  correction.misalignment_rad = 0.02;
  EXPECT_NEAR(*corrected_heading(correction, reading), 1.0 - 0.1 * std::sin(1.0) - 0.02, 1e-12);
  // A field with the same hard iron taken out: the deviation of the device's own heading has no part in it.
  const double truth = 2.0;
  reading.field_body_uT = Eigen::Vector3d(20 * std::cos(truth) + 3, -20 * std::sin(truth) - 4, 40);
  reading.roll_rad = reading.pitch_rad = 0;
  correction.magnetometer = FieldCorrection{{3, -4, 0}, Eigen::Matrix3d::Identity()};
  EXPECT_NEAR(*corrected_heading(correction, reading), truth - 0.02, 1e-12);
  reading.roll_rad.reset();
  EXPECT_NEAR(*corrected_heading(correction, reading), 1.0 - 0.1 * std::sin(1.0) - 0.02, 1e-12)
      << "without tilt the field cannot be levelled";
}

TEST(Correction, TheFieldIsLevelledByRollAndPitch) {
  for (const double heading : {0.1, 1.7, 3.2, 5.9}) {
    for (const double roll : {-0.3, 0.0, 0.4}) {
      for (const double pitch : {-0.2, 0.0, 0.35}) {
        const Eigen::Vector3d north_east_down(19, 0, 44);
        const Eigen::Matrix3d to_body = (Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) *
                                         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                                            .toRotationMatrix()
                                            .transpose();
        EXPECT_NEAR(levelled_heading(to_body * north_east_down, roll, pitch), heading, 1e-12);
      }
    }
  }
}

TEST(Correction, ASwingIsATableWithStraightLinesBetween) {
  SwingCorrection swing;
  swing.deviation_rad = {0.1, 0.2, 0, 0, 0, 0, 0, 0.3};
  constexpr double kSector = std::numbers::pi / 4;
  EXPECT_NEAR(swing(0), -0.1, 1e-12);
  EXPECT_NEAR(swing(kSector / 2), kSector / 2 - 0.15, 1e-12);
  EXPECT_NEAR(swing(7.5 * kSector), 7.5 * kSector - 0.2, 1e-12);
}

}  // namespace
}  // namespace navcal::calib
