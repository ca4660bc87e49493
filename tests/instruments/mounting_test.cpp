// SPDX-License-Identifier: Apache-2.0
#include "instruments/mounting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/angles.h"
#include "base/rotation.h"
#include "base/vectors.h"

namespace navcal::instruments {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Value = decltype(Sample::value);

constexpr double kDegree = base::kRadiansPerDegree;

config::MountingSettings turned_by(double roll_deg, double pitch_deg, double yaw_deg) {
  config::MountingSettings settings;
  settings.rotation_deg = {roll_deg, pitch_deg, yaw_deg};
  return settings;
}

Matrix3d body_from_device(const config::MountingSettings& settings) {
  const auto& [roll_deg, pitch_deg, yaw_deg] = settings.rotation_deg;
  return base::rotation_of({roll_deg * kDegree, pitch_deg * kDegree, yaw_deg * kDegree});
}

Vector3 array_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

template <class Kind>
Kind in_body(const config::MountingSettings& settings, const Kind& device) {
  Value value = device;
  Mounting(settings).to_body(value);
  return std::get<Kind>(value);
}

/// What a compass with such a mounting shows in a vehicle with these angles.
CompassSample shown(const config::MountingSettings& settings, const base::EulerAngles& vehicle,
                    const Vector3d& field_uT) {
  const Matrix3d device = body_from_device(settings);
  const base::EulerAngles angles = base::angles_of(base::rotation_of(vehicle) * device);
  CompassSample sample;
  sample.roll_rad = angles.roll_rad;
  sample.pitch_rad = angles.pitch_rad;
  sample.heading_rad = base::as_heading(angles.yaw_rad);
  sample.field_body_uT = array_of(device.transpose() * field_uT);
  return sample;
}

TEST(Mounting, WithoutARotationNothingChangesToTheLastBit) {
  config::MountingSettings away;
  away.position_m = {1, 2, 3};
  CompassSample compass;
  compass.heading_rad = 7;  // not even where it could be made a better heading
  compass.pitch_rad = 0.1;
  compass.field_body_uT = {1, 2, -0.0};
  const CompassSample same = in_body(away, compass);
  EXPECT_EQ(same.heading_rad, 7);
  EXPECT_EQ(same.pitch_rad, 0.1);
  EXPECT_FALSE(same.roll_rad);
  EXPECT_TRUE(std::signbit((*same.field_body_uT)[2]));
  ImuSample imu;
  imu.rate_rad_s = Vector3{0.1, 0.2, -0.0};
  EXPECT_TRUE(std::signbit(in_body(away, imu).rate_rad_s.value()[2]));
}

TEST(Mounting, ACompassThatLooksToStarboardShowsAHeadingThatIsTooLarge) {
  const auto settings = turned_by(0, 0, 90);
  CompassSample device;
  device.heading_rad = 100 * kDegree;
  device.roll_rad = 0.05;
  device.pitch_rad = 0.02;
  const CompassSample body = in_body(settings, device);
  EXPECT_NEAR(*body.heading_rad, 10 * kDegree, 0.002);
  EXPECT_NEAR(*body.pitch_rad, 0.05, 1e-4) << "its starboard, which is down, is the vehicle's stern";
  EXPECT_NEAR(*body.roll_rad, -0.02, 1e-4) << "its nose, which is up, is the vehicle's starboard";
}

TEST(Mounting, ACompassUpsideDownTurnsTheOtherWay) {
  const auto settings = turned_by(180, 0, 0);
  const base::EulerAngles vehicle{0.1, 0.05, 30 * kDegree};
  const CompassSample device = shown(settings, vehicle, {20, 5, 40});
  EXPECT_NEAR(std::abs(*device.roll_rad), std::numbers::pi - 0.1, 1e-12);
  const CompassSample body = in_body(settings, device);
  EXPECT_NEAR(*body.roll_rad, 0.1, 1e-12);
  EXPECT_NEAR(*body.pitch_rad, 0.05, 1e-12);
  EXPECT_NEAR(*body.heading_rad, 30 * kDegree, 1e-12);
  EXPECT_NEAR((*body.field_body_uT)[2], 40, 1e-12);
}

TEST(Mounting, AnyCompassGivesTheVehiclesAngles) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any_deg(-180, 180), tilt(-1.2, 1.2), heading(0, base::kTurn_rad);
  for (int i = 0; i < 1000; ++i) {
    const auto settings = turned_by(any_deg(random), any_deg(random), any_deg(random));
    const base::EulerAngles vehicle{tilt(random), tilt(random), heading(random)};
    const Vector3d field_uT(20 * tilt(random), 20, 40 * tilt(random));
    const CompassSample body = in_body(settings, shown(settings, vehicle, field_uT));
    EXPECT_NEAR(*body.roll_rad, vehicle.roll_rad, 1e-7);
    EXPECT_NEAR(*body.pitch_rad, vehicle.pitch_rad, 1e-7);
    EXPECT_NEAR(base::wrapped(*body.heading_rad - vehicle.yaw_rad), 0, 1e-7);
    EXPECT_TRUE(base::vector_of(*body.field_body_uT).isApprox(field_uT, 1e-12));
  }
}

TEST(Mounting, AHeadingAloneLosesTheYawAndHalfATiltIsNone) {
  CompassSample device;
  device.heading_rad = 10 * kDegree;
  device.pitch_rad = 0.1;
  const CompassSample body = in_body(turned_by(0, 0, 30), device);
  EXPECT_NEAR(*body.heading_rad, 340 * kDegree, 1e-12);
  EXPECT_FALSE(body.pitch_rad) << "without the roll it cannot be turned";
}

TEST(Mounting, ATiltWithoutAHeadingIsTurnedAndMakesNone) {
  const auto settings = turned_by(0, 0, 90);
  CompassSample device;
  device.roll_rad = 0.2;
  device.pitch_rad = 0;
  const CompassSample body = in_body(settings, device);
  EXPECT_FALSE(body.heading_rad);
  EXPECT_NEAR(*body.pitch_rad, 0.2, 1e-12);
}

TEST(Mounting, RatesAndForceOfTheCardAreTurned) {
  const auto settings = turned_by(0, 90, 0);  // its x axis points up, its z axis forward
  ImuSample device;
  device.rate_rad_s = {1, 2, 3};
  device.yaw_rate_b_rad_s = 4;
  device.specific_force_m_s2 = {9.81, 0, 0};
  const ImuSample body = in_body(settings, device);
  EXPECT_NEAR(body.rate_rad_s.value()[0], 3, 1e-12);
  EXPECT_NEAR(body.rate_rad_s.value()[1], 2, 1e-12);
  EXPECT_NEAR(body.rate_rad_s.value()[2], -1, 1e-12);
  EXPECT_NEAR(body.yaw_rate_b_rad_s.value(), -1, 1e-12) << "the second z gyro now measures roll";
  EXPECT_NEAR(body.specific_force_m_s2.value()[2], -9.81, 1e-12);
}

TEST(Mounting, TheSecondYawGyroKeepsItsPlaceWhenTheCardLooksAside) {
  ImuSample device;
  device.rate_rad_s = {0.1, 0.2, 0.3};
  device.yaw_rate_b_rad_s = 0.31;
  const ImuSample body = in_body(turned_by(180, 0, 40), device);
  EXPECT_NEAR(body.rate_rad_s.value()[2], -0.3, 1e-12);
  EXPECT_NEAR(body.yaw_rate_b_rad_s.value(), -0.31, 1e-12);
}

TEST(Mounting, PositionsAreLeftAlone) {
  GpsSample gps;
  gps.latitude_rad = 1;
  gps.course_rad = 2;
  const GpsSample same = in_body(turned_by(10, 20, 30), gps);
  EXPECT_EQ(same.latitude_rad, 1);
  EXPECT_EQ(same.course_rad, 2);
}

}  // namespace
}  // namespace navcal::instruments
