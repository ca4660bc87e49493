// SPDX-License-Identifier: Apache-2.0
#include "base/rotation.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "base/angles.h"

namespace navcal::base {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kQuarter = std::numbers::pi / 2;
const Vector3d kForward = Vector3d::UnitX(), kStarboard = Vector3d::UnitY(), kDown = Vector3d::UnitZ();

TEST(Rotation, EachAxisTurnsTheRightWay) {
  const Matrix3d starboard_down = rotation_of({kQuarter, 0, 0});
  EXPECT_TRUE((starboard_down * kForward).isApprox(kForward));
  EXPECT_TRUE((starboard_down * kStarboard).isApprox(kDown)) << "the inner y axis points down";
  const Matrix3d nose_up = rotation_of({0, kQuarter, 0});
  EXPECT_TRUE((nose_up * kForward).isApprox(-kDown));
  const Matrix3d to_starboard = rotation_of({0, 0, kQuarter});
  EXPECT_TRUE((to_starboard * kForward).isApprox(kStarboard));
  EXPECT_TRUE((to_starboard * kDown).isApprox(kDown));
}

TEST(Rotation, AnglesAreYawThenPitchThenRoll) {
  const EulerAngles angles{0.3, -0.4, 1.2};
  const Matrix3d composed = rotation_of({0, 0, angles.yaw_rad}) * rotation_of({0, angles.pitch_rad, 0}) *
                            rotation_of({angles.roll_rad, 0, 0});
  EXPECT_TRUE(rotation_of(angles).isApprox(composed, 1e-15));
}

TEST(Rotation, HalfTurnsLeaveOneAxis) {
  EXPECT_TRUE(rotation_of({std::numbers::pi, 0, 0}).isApprox(Vector3d(1, -1, -1).asDiagonal().toDenseMatrix()));
  EXPECT_TRUE(rotation_of({0, std::numbers::pi, 0}).isApprox(Vector3d(-1, 1, -1).asDiagonal().toDenseMatrix()));
  EXPECT_TRUE(rotation_of({0, 0, std::numbers::pi}).isApprox(Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix()));
}

TEST(Rotation, AnglesComeBack) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-3.1, 3.1), pitch(-1.5, 1.5);
  for (int i = 0; i < 1000; ++i) {
    const EulerAngles angles{any(random), pitch(random), any(random)};
    const Matrix3d rotation = rotation_of(angles);
    EXPECT_TRUE((rotation * rotation.transpose()).isIdentity(1e-14));
    EXPECT_NEAR(rotation.determinant(), 1, 1e-14);
    const EulerAngles back = angles_of(rotation);
    EXPECT_NEAR(wrapped(back.roll_rad - angles.roll_rad), 0, 1e-12);
    EXPECT_NEAR(back.pitch_rad, angles.pitch_rad, 1e-12);
    EXPECT_NEAR(wrapped(back.yaw_rad - angles.yaw_rad), 0, 1e-12);
  }
}

TEST(Rotation, ThePitchOfAMatrixThatRoundingMadeTooLargeIsARightAngle) {
  Matrix3d rotation = rotation_of({0, -kQuarter, 0});
  rotation(2, 0) = 1 + 1e-15;
  EXPECT_DOUBLE_EQ(angles_of(rotation).pitch_rad, -kQuarter);
}

TEST(Rotation, DepthOfAPointIsThatOfTheWholeRotation) {
  const Vector3d position_m(1.5, -0.4, 0.3);
  for (const double roll_rad : {-0.5, 0.0, 0.7}) {
    for (const double pitch_rad : {-0.9, 0.0, 0.2}) {
      EXPECT_NEAR(depth_below_origin_m(position_m, roll_rad, pitch_rad),
                  (rotation_of({roll_rad, pitch_rad, 2.2}) * position_m).z(), 1e-15);
    }
  }
  EXPECT_NEAR(depth_below_origin_m(kForward, 0, 0.1), -std::sin(0.1), 1e-15) << "nose up: the nose is higher";
  EXPECT_NEAR(depth_below_origin_m(kStarboard, 0.1, 0), std::sin(0.1), 1e-15) << "starboard down";
}

}  // namespace
}  // namespace navcal::base
