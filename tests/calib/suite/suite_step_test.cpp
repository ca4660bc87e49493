// SPDX-License-Identifier: Apache-2.0
// A calibration must not outlive its field: what a step of the field does to what is in force.
#include <gtest/gtest.h>

#include <cmath>

#include "base/angles.h"
#include "calib/suite/suite.h"
#include "tests/calib/magnetometer_paths.h"
#include "tests/calib/suite/suite_drive.h"

namespace navcal::calib {
namespace {

using namespace test;

constexpr double kReading_s = 0.1;
const Eigen::Vector3d kIron_uT(3, -2, 1);

Attitude tumbling(double i) {
  return {0.11 * i + std::sin(0.031 * i), 0.8 * std::sin(0.083 * i), 0.7 * std::sin(0.057 * i)};
}

/// Body rates between two attitudes, rad/s.
Eigen::Vector3d rates_at(double i) {
  constexpr double kHalf = 0.5;
  const Attitude before = tumbling(i - kHalf), now = tumbling(i), after = tumbling(i + kHalf);
  const double yaw = (after.heading_rad - before.heading_rad) / kReading_s,
               pitch = (after.pitch_rad - before.pitch_rad) / kReading_s,
               roll = (after.roll_rad - before.roll_rad) / kReading_s;
  return {roll - yaw * std::sin(now.pitch_rad),
          pitch * std::cos(now.roll_rad) + yaw * std::sin(now.roll_rad) * std::cos(now.pitch_rad),
          yaw * std::cos(now.roll_rad) * std::cos(now.pitch_rad) - pitch * std::sin(now.roll_rad)};
}

/// A vehicle that tumbles, with compass and gyro.
class Tumbler {
 public:
  explicit Tumbler(std::uint64_t seed, bool automatic = false)
      : automatic_(automatic), suite_(options(), {.compass = true, .rate = true}), random_(seed) {}

  /// Goes on in a field with this hard iron. Returns the root-mean-square error of the calibrated heading over the
  /// readings after the first `settling`, rad; not a number without one.
  double go(int readings, const Eigen::Vector3d& hard_uT, int settling = 0) {
    double squares = 0;
    int count = 0;
    for (int k = 0; k < readings; ++k, ++i_) {
      Iron iron;
      iron.hard_uT = hard_uT;
      const FieldReading field = field_on({tumbling(i_)}, iron, random_).front();
      RateReading rate;
      rate.time_s = kReading_s * i_;
      rate.rate_rad_s = rates_at(i_);
      suite_.put(rate);
      CompassReading reading;
      reading.time_s = kReading_s * i_;
      reading.roll_rad = field.roll_rad;
      reading.pitch_rad = field.pitch_rad;
      reading.field_body_uT = field.field_body_uT;
      reading.heading_rad = levelled_heading(field.field_body_uT, field.roll_rad, field.pitch_rad);
      if (const auto heading_rad = corrected_heading(suite_.in_force().correction(), reading);
          heading_rad && k >= settling) {
        const double error_rad = base::wrapped(*heading_rad - tumbling(i_).heading_rad);
        squares += std::pow(error_rad, 2);
        ++count;
      }
      suite_.put(reading);
    }
    return std::sqrt(squares / count);
  }
  /// The suite is another one that was given the saved state.
  void restart() { suite_ = restored(saved(suite_), options(), {.compass = true, .rate = true}); }
  [[nodiscard]] Suite& suite() { return suite_; }
  [[nodiscard]] const Correction& in_force() const { return suite_.in_force().correction(); }

 private:
  [[nodiscard]] SuiteOptions options() const {
    SuiteOptions options;
    options.tilt_lag_s = 0;
    options.automatic = automatic_;
    return options;
  }
  bool automatic_;
  Suite suite_;
  Random random_;
  int i_ = 0;
};

constexpr int kFound = 100;  // readings until a step is told, with the time for which the gate looks ahead

TEST(SuiteAtAStep, TheIronInForceMovesWithTheFieldAndComesBackWithIt) {
  for (const double size_uT : {6.0, 14.0, 27.0, 58.0}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Eigen::Vector3d step_uT = size_uT * Eigen::Vector3d(0.6, seed == 2 ? -0.5 : 0.5, 0.62).normalized();
      Tumbler vehicle(seed);
      vehicle.go(600, kIron_uT);
      ASSERT_EQ(vehicle.suite().accept(Calibrator::magnetometer), "");
      EXPECT_LT(vehicle.go(200, kIron_uT), 0.03);
      EXPECT_LT(vehicle.go(400, kIron_uT + step_uT, kFound), 0.06) << size_uT << " uT, seed " << seed;
      ASSERT_TRUE(vehicle.in_force().magnetometer);
      EXPECT_LT((vehicle.in_force().magnetometer->offset_uT - kIron_uT - step_uT).norm(), 1.2);
      EXPECT_LT(vehicle.go(400, kIron_uT, kFound), 0.03) << size_uT << " uT, seed " << seed;
    }
  }
}

// A step that is told in the first seconds is withdrawn when the magnet goes, in the same moment in which that is
// told.
TEST(SuiteAtAStep, AMagnetOfTheBeginningGoes) {
  const Eigen::Vector3d step_uT(8.5, 7.1, 8.5);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const int readings : {20, 60, 90}) {
      Tumbler vehicle(seed);
      vehicle.go(readings, kIron_uT);
      vehicle.go(800, kIron_uT + step_uT);
      ASSERT_EQ(vehicle.suite().accept(Calibrator::magnetometer, true), "");
      EXPECT_LT(vehicle.go(200, kIron_uT + step_uT), 0.1);
      EXPECT_LT(vehicle.go(400, kIron_uT, kFound), 0.1) << readings << " readings, seed " << seed;
    }
  }
}

TEST(SuiteAtAStep, WhatWasAdoptedBesideAMagnetLeavesWithItWhereReadingsAreMoreEvenWithoutIt) {
  int left = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Tumbler vehicle(seed);
    vehicle.go(600, Eigen::Vector3d::Zero());
    vehicle.go(100, {0, 0, 58});  // too few for the shape
    ASSERT_EQ(vehicle.suite().accept(Calibrator::magnetometer, true), "");
    vehicle.go(400, Eigen::Vector3d::Zero());
    const bool has_returned = vehicle.suite().report().steps.back().returned;
    left += vehicle.in_force().magnetometer ? 0 : 1;
    EXPECT_TRUE(!has_returned || !vehicle.in_force().magnetometer ||
                vehicle.go(200, Eigen::Vector3d::Zero()) < 0.03)
        << "seed " << seed;
  }
  EXPECT_GT(left, 0);
}

TEST(SuiteAtAStep, TheErrorInForceGrowsAndShrinksAsReadingsConfirm) {
  Tumbler vehicle(4);
  vehicle.go(600, kIron_uT);
  ASSERT_EQ(vehicle.suite().accept(Calibrator::magnetometer), "");
  const auto error_uT = [&] {
    const Report report = vehicle.suite().report();
    return report.find(Calibrator::magnetometer)->step_std_uT.norm();
  };
  EXPECT_EQ(error_uT(), 0);
  vehicle.go(60, kIron_uT + Eigen::Vector3d(9, -6, 8));
  const double at_once_uT = error_uT();
  EXPECT_GT(at_once_uT, 0.05);
  vehicle.go(800, kIron_uT + Eigen::Vector3d(9, -6, 8));
  EXPECT_LT(error_uT(), 0.7 * at_once_uT);
  EXPECT_GT(error_uT(), 0);
}

TEST(SuiteAtAStep, ADeviationLeavesForceAndComesBackWithItsField) {
  Tumbler vehicle(5);
  vehicle.go(1200, kIron_uT);
  ASSERT_EQ(vehicle.suite().accept(Calibrator::compass, true), "");
  const auto learnt_rad = vehicle.in_force().compass->coefficients_rad;
  vehicle.go(100, kIron_uT);
  vehicle.go(kFound, kIron_uT + Eigen::Vector3d(14, 3, 0));
  EXPECT_FALSE(vehicle.in_force().compass);
  EXPECT_TRUE(vehicle.suite().take_adopted() == Calibrator::compass) << "the change is told";
  vehicle.go(200, kIron_uT + Eigen::Vector3d(14, 3, 0));
  vehicle.go(kFound, kIron_uT);
  ASSERT_TRUE(vehicle.in_force().compass);
  EXPECT_EQ(vehicle.in_force().compass->coefficients_rad, learnt_rad);
}

TEST(SuiteAtAStep, NothingLearntBeforeItIsHeldOutAfterIt) {
  Tumbler vehicle(6);
  vehicle.go(1500, kIron_uT);
  const auto judged = [&] {
    const Report report = vehicle.suite().report();
    return report.find(Calibrator::magnetometer)->judgement.held_out_quantity != HeldOutQuantity::none;
  };
  EXPECT_TRUE(judged());
  vehicle.go(60, kIron_uT + Eigen::Vector3d(9, -6, 8));
  EXPECT_FALSE(judged());
}

// A restart of the program after a step: the step is not told twice, and its end is followed.
TEST(SuiteAtAStep, SavedAndRestoredItFollowsTheFieldAlike) {
  const Eigen::Vector3d step_uT(14, 9, -8);
  Tumbler whole(7), restarted(7);
  const auto same = [&] {
    const Report one = whole.suite().report(), other = restarted.suite().report();
    EXPECT_EQ(one.rose, other.rose);
    EXPECT_EQ(one.find(Calibrator::magnetometer)->step_std_uT, other.find(Calibrator::magnetometer)->step_std_uT);
    EXPECT_EQ(whole.in_force().magnetometer->offset_uT, restarted.in_force().magnetometer->offset_uT);
    EXPECT_EQ(saved(whole.suite()), saved(restarted.suite()));
  };
  for (Tumbler* const vehicle : {&whole, &restarted}) {
    vehicle->go(600, kIron_uT);
    ASSERT_EQ(vehicle->suite().accept(Calibrator::magnetometer), "");
    vehicle->go(kFound, kIron_uT + step_uT);
    EXPECT_TRUE(vehicle->suite().take_field_step());
  }
  restarted.restart();
  EXPECT_FALSE(restarted.suite().take_field_step()) << "it was told before";
  same();
  for (Tumbler* const vehicle : {&whole, &restarted}) vehicle->go(300, kIron_uT);
  same();
  EXPECT_LT((restarted.in_force().magnetometer->offset_uT - kIron_uT).norm(), 1.2);
}

// Without iron no calibration is better than none, whatever else is well known.
TEST(SuiteAtAStep, WhereNothingIsToBeGainedNothingComesIntoForce) {
  Tumbler without(8, true), with(8, true);
  without.go(1500, Eigen::Vector3d::Zero());
  with.go(1500, kIron_uT);
  EXPECT_FALSE(without.in_force().magnetometer);
  EXPECT_TRUE(with.in_force().magnetometer);
}

}  // namespace
}  // namespace navcal::calib
