// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/field_comparison.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "base/angles.h"

namespace navcal::calib {
namespace {

/// A level turn with some roll in a field of 48 uT, read with hard iron and noise.
class Turning {
 public:
  explicit Turning(const Eigen::Vector3d& offset_uT) : offset_uT_(offset_uT) {}

  CompassReading next() {
    const double heading = 0.05 * count_, roll = 10 * base::kRadiansPerDegree * std::sin(0.013 * count_);
    ++count_;
    const Eigen::Vector3d level(19 * std::cos(heading), -19 * std::sin(heading), 44);
    CompassReading reading;
    reading.field_body_uT = Eigen::AngleAxisd(-roll, Eigen::Vector3d::UnitX()) * level + offset_uT_ +
                            Eigen::Vector3d(noise(), noise(), noise());
    reading.roll_rad = roll;
    reading.pitch_rad = 0;
    return reading;
  }

 private:
  double noise() { return 0.15 * normal_(random_); }
  Eigen::Vector3d offset_uT_;
  int count_ = 0;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
};

Correction with_offset(const Eigen::Vector3d& offset_uT) {
  Correction correction;
  correction.magnetometer = FieldCorrection{offset_uT, Eigen::Matrix3d::Identity()};
  return correction;
}

FieldComparison judged(const Eigen::Vector3d& offset_uT, const Correction& in_force, const Correction& estimates,
                       int readings = 2000) {
  Turning turning(offset_uT);
  FieldComparison comparison;
  for (int i = 0; i < readings; ++i) comparison.update(turning.next(), in_force, estimates);
  return comparison;
}

TEST(FieldComparison, TheRightOffsetIsBetterThanNone) {
  const Eigen::Vector3d offset(5, -3, 2);
  const FieldComparison found = judged(offset, {}, with_offset(offset));
  EXPECT_TRUE(found.comparison().better_by(0.1));
  EXPECT_LT(found.comparison().estimate_rms(), 0.01);
  EXPECT_GT(found.comparison().before_rms(), 0.03);
}

TEST(FieldComparison, AWrongOffsetIsNotAndNeitherIsTheSameAgain) {
  const Eigen::Vector3d offset(5, -3, 2);
  EXPECT_TRUE(judged(Eigen::Vector3d::Zero(), {}, with_offset(offset)).comparison().contradicts());
  EXPECT_FALSE(judged(offset, with_offset(offset), with_offset(offset)).comparison().better_by(0.1));
}

TEST(FieldComparison, WithoutAnEstimateOrAFieldNothingIsJudged) {
  EXPECT_EQ(judged({5, 0, 0}, {}, {}).comparison().blocks(), 0U);
  FieldComparison comparison;
  CompassReading heading_only;
  heading_only.heading_rad = 1;
  for (int i = 0; i < 500; ++i) EXPECT_FALSE(comparison.update(heading_only, {}, with_offset({1, 0, 0})));
  EXPECT_EQ(comparison.comparison().blocks(), 0U);
}

TEST(FieldComparison, TiltIsNotNeeded) {
  Turning turning({5, -3, 2});
  FieldComparison comparison;
  for (int i = 0; i < 2000; ++i) {
    CompassReading reading = turning.next();
    reading.roll_rad.reset();
    comparison.update(reading, {}, with_offset({5, -3, 2}));
  }
  EXPECT_TRUE(comparison.comparison().better_by(0.1));
}

}  // namespace
}  // namespace navcal::calib
