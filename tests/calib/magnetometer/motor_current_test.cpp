// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/motor_current.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calib/correction.h"

namespace navcal::calib {
namespace {

const Eigen::Vector3d kSlope_uT_per_A(0.6, -0.3, 0.8);

/// A vehicle that turns and rolls gently, with instruments of the nominal kind, seen at 20 and 10 Hz.
class Vehicle {
 public:
  explicit Vehicle(std::uint64_t seed) : random_(seed) {}

  Eigen::Vector3d slope_uT_per_A = kSlope_uT_per_A;
  Eigen::Vector3d hard_iron_uT{20, -15, 10};
  double yaw_rate_rad_s = 0.05;
  bool turns_with_current = false;  ///< the yaw rate follows the current
  bool reports_current = true;
  bool blind_at_changes = false;  ///< no field from 0.5 s before to 2 s after a change, as the gate leaves it

  /// Lasts `duration_s`; the current changes every `period_s` between 0.7 and 2.4 A.
  void sail(MotorCurrent& motor, double duration_s, double period_s) {
    const Eigen::Vector3d bias_rad_s(0.006, -0.004, 0.008);
    for (int tick = 0; tick < duration_s * 20; ++tick, time_s_ += 0.05) {
      const bool fast = period_s > 0 && std::fmod(time_s_, 2 * period_s) > period_s;
      current_A_ += 0.05 * ((fast ? 2.4 : 0.7) - current_A_) / 0.5;
      const double yaw = turns_with_current ? 0.2 * (current_A_ - 1.5) : yaw_rate_rad_s;
      const Eigen::Vector3d rate(0.05 * std::cos(0.7 * time_s_), 0.03 * std::sin(0.4 * time_s_), yaw);
      if (tick % 2 == 0) {
        MotorReading reading{time_s_, 800, current_A_ + normal(0.02)};
        if (!reports_current) reading.current_A.reset();
        motor.update(reading);
        if (!(blind_at_changes && std::fmod(time_s_ + 0.5, period_s) < 2.5))
          motor.update(compass(), Eigen::Vector3d::Zero());
      }
      RateReading measured;
      measured.time_s = time_s_;
      measured.rate_rad_s = rate + bias_rad_s + Eigen::Vector3d(normal(0.00175), normal(0.00175), normal(0.00175));
      motor.update(measured);
      const Eigen::Vector3d turn_rad = 0.05 * rate;
      earth_uT_ = Eigen::AngleAxisd(-turn_rad.norm(), turn_rad.normalized()) * earth_uT_;
    }
  }

 private:
  CompassReading compass() {
    CompassReading reading;
    reading.time_s = time_s_;
    const Eigen::Vector3d noise_uT(normal(0.15), normal(0.15), normal(0.15));
    reading.field_body_uT = earth_uT_ + hard_iron_uT + current_A_ * slope_uT_per_A + noise_uT;
    return reading;
  }
  double normal(double sigma) { return sigma * normal_(random_); }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Eigen::Vector3d earth_uT_{17, 5, 45};
  double time_s_ = 0, current_A_ = 0.7;
};

MotorCurrent calibrator() { return MotorCurrent({0.2, 0.0004}); }

TEST(MotorCurrent, IsFoundWithinItsStatedErrors) {
  int within = 0, all = 0;
  double square = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Vehicle vehicle(seed);
    MotorCurrent motor = calibrator();
    vehicle.sail(motor, 130, 15);
    motor.finish();
    ASSERT_TRUE(motor.judgement().accepted) << motor.judgement().reason;
    const auto found = motor.estimate();
    EXPECT_LT((found->slope_uT_per_A - kSlope_uT_per_A).norm(), 0.1 * kSlope_uT_per_A.norm()) << seed;
    for (Eigen::Index i = 0; i < 3; ++i, ++all) {
      const double error = found->slope_uT_per_A[i] - kSlope_uT_per_A[i];
      within += error * error < 4 * found->covariance(i, i) ? 1 : 0;
      square += error * error / found->covariance(i, i);
    }
  }
  EXPECT_GE(within, 31);  // 95.4 % of 36: lower 99.9 % binomial limit is 30
  EXPECT_GT(square / all, 0.3) << "errors are not stated far too large";
}

TEST(MotorCurrent, IsFoundWithoutReadingsAboutTheChanges) {
  Vehicle vehicle(7);
  vehicle.blind_at_changes = true;
  MotorCurrent motor = calibrator();
  vehicle.sail(motor, 130, 15);
  ASSERT_TRUE(motor.judgement().accepted) << motor.judgement().reason;
  EXPECT_LT((motor.estimate()->slope_uT_per_A - kSlope_uT_per_A).norm(), 0.15 * kSlope_uT_per_A.norm());
}

TEST(MotorCurrent, ATurnThatFollowsTheCurrentIsNotTakenForItsField) {
  Vehicle vehicle(3);
  vehicle.slope_uT_per_A = Eigen::Vector3d::Zero();
  vehicle.turns_with_current = true;
  MotorCurrent motor = calibrator();
  vehicle.sail(motor, 130, 15);
  EXPECT_FALSE(motor.judgement().accepted) << "there is no field of the motor";
  const auto found = motor.estimate();
  ASSERT_TRUE(found);
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(found->slope_uT_per_A[i]), 4 * std::sqrt(found->covariance(i, i)));
  }
}

TEST(MotorCurrent, ASteadyCurrentIsRefusedWithTheManoeuvre) {
  Vehicle vehicle(1);
  MotorCurrent motor = calibrator();
  vehicle.sail(motor, 120, 0);
  EXPECT_FALSE(motor.estimate());
  const Judgement judgement = motor.judgement();
  EXPECT_FALSE(judgement.accepted);
  EXPECT_NE(judgement.reason.find("hardly changed"), std::string::npos) << judgement.reason;
  EXPECT_NE(judgement.manoeuvre.find("change the shaft speed"), std::string::npos) << judgement.manoeuvre;
}

TEST(MotorCurrent, ACardWithoutCurrentIsNamed) {
  Vehicle vehicle(1);
  vehicle.reports_current = false;
  MotorCurrent motor = calibrator();
  vehicle.sail(motor, 60, 15);
  EXPECT_EQ(motor.judgement().reason, "the motor card reports no current");
}

TEST(MotorCurrent, HeldOutWindowsAreFitBetterWithIt) {
  Vehicle vehicle(2);
  MotorCurrent motor = calibrator();
  vehicle.sail(motor, 200, 15);
  EXPECT_GT(motor.comparison().blocks(), 3U);
  EXPECT_GT(motor.comparison().before_rms(), 1.2 * motor.comparison().estimate_rms());
  EXPECT_TRUE(motor.comparison().better_by(0.1));
}

TEST(MotorCurrent, GoesOnFromItsArchiveToTheLastBit) {
  Vehicle vehicle(4);
  MotorCurrent motor = calibrator();
  vehicle.sail(motor, 67, 15);
  Archive saving;
  motor.archive(saving);
  MotorCurrent restored = calibrator();
  Archive restoring(saving.bytes());
  restored.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  Vehicle same = vehicle;
  vehicle.sail(motor, 40, 15);
  same.sail(restored, 40, 15);
  EXPECT_EQ(motor.estimate()->slope_uT_per_A, restored.estimate()->slope_uT_per_A);
  Archive one, other;
  motor.archive(one);
  restored.archive(other);
  EXPECT_EQ(one.bytes(), other.bytes());
}

TEST(MotorCurrent, NothingIsLearntAcrossAGapOfTheGyros) {
  MotorCurrent motor = calibrator();
  Vehicle vehicle(5);
  vehicle.sail(motor, 14.5, 15);
  RateReading late;
  late.time_s = 20;
  motor.update(late);
  motor.finish();
  EXPECT_FALSE(motor.estimate()) << "the change came after the gap";
}

TEST(CurrentTrack, LiesBetweenTheReadings) {
  CurrentTrack track;
  for (int i = 0; i < 100; ++i) track.update({0.1 * i, 500, 0.5 + 0.1 * i});
  EXPECT_NEAR(track.at(9.85).value_or(0), 10.35, 1e-9);
  EXPECT_NEAR(track.at(9.9).value_or(0), 10.4, 1e-9);
  EXPECT_FALSE(track.at(10.0)) << "not known yet";
  EXPECT_NEAR(track.at_or_newest(10.0).value_or(0), 10.4, 1e-9);
  EXPECT_FALSE(track.newest(11.5)) << "too old";
  EXPECT_FALSE(track.at(1.0)) << "forgotten";
}

TEST(Correction, TheMotorsFieldIsTakenOffBeforeTheLevelling) {
  Correction correction;
  correction.motor_current = MotorCurrentCorrection{{1, -2, 0.5}};
  CompassReading reading;
  reading.field_body_uT = Eigen::Vector3d(18 + 2, 0 - 4, 45 + 1);
  reading.roll_rad = reading.pitch_rad = 0;
  reading.heading_rad = levelled_heading(*reading.field_body_uT, 0, 0);
  const CompassReading without = without_motor_field(correction, reading, 2);
  EXPECT_LT((*without.field_body_uT - Eigen::Vector3d(18, 0, 45)).norm(), 1e-12);
  EXPECT_NEAR(std::remainder(*without.heading_rad, 2 * M_PI), 0, 1e-12);
  EXPECT_NEAR(std::remainder(*corrected_heading(correction, without), 2 * M_PI), 0, 1e-12);
  EXPECT_EQ(*without_motor_field(correction, reading, std::nullopt).field_body_uT, *reading.field_body_uT);
  EXPECT_EQ(*without_motor_field({}, reading, 2).field_body_uT, *reading.field_body_uT);
}

}  // namespace
}  // namespace navcal::calib
