// SPDX-License-Identifier: Apache-2.0
#include "instruments/autopilot_compass.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>

namespace navcal::instruments {
namespace {

/// A calibration and what an autopilot makes of a field by it.
struct Calibration {
  Eigen::Vector3d offset_mG, diagonal, off_diagonal, motor_mG_per_A;
  double scale = 1;

  [[nodiscard]] Vector3 sent_uT(const Eigen::Vector3d& measured_uT, double current_A) const {
    Eigen::Matrix3d d = diagonal.asDiagonal();
    d(0, 1) = d(1, 0) = off_diagonal[0];
    d(0, 2) = d(2, 0) = off_diagonal[1];
    d(1, 2) = d(2, 1) = off_diagonal[2];
    const Eigen::Vector3d sent = 0.1 * (d * (10 * measured_uT + offset_mG) * scale + motor_mG_per_A * current_A);
    return {sent.x(), sent.y(), sent.z()};
  }
  [[nodiscard]] double value(const std::string& name) const {
    if (name == "COMPASS_MOTCT") return 2;
    if (name.find("SCALE") != std::string::npos) return scale;
    const int axis = name.back() - 'X';
    for (const auto& [kind, values] : {std::pair{"DIA", diagonal}, std::pair{"ODI", off_diagonal},
                                       std::pair{"MOT", motor_mG_per_A}, std::pair{"OFS", offset_mG}})
      if (name.find(kind) != std::string::npos) return values[axis];
    return std::numeric_limits<double>::quiet_NaN();
  }
};

Calibration random_calibration(std::mt19937& random) {
  std::uniform_real_distribution<double> of(-1, 1);
  const auto vector = [&](double size) {
    return Eigen::Vector3d(Eigen::Vector3d(of(random), of(random), of(random)) * size);
  };
  return {vector(300), Eigen::Vector3d::Ones() + vector(0.2), vector(0.1), vector(10), 1 + 0.2 * of(random)};
}

TEST(AutopilotCompass, UndoesAnyCalibrationOfEachUnit) {
  std::mt19937 random(7);
  for (int unit = 0; unit < AutopilotCompass::kUnits; ++unit) {
    for (int i = 0; i < 20; ++i) {
      const Calibration calibration = random_calibration(random);
      AutopilotCompass compass;
      const Eigen::Vector3d field_uT(20.0 - i, 3, 43);
      const Vector3 sent_uT = calibration.sent_uT(field_uT, 7.5);
      for (const std::string& name : AutopilotCompass::names(unit)) {
        EXPECT_FALSE(compass.measured_uT(unit, sent_uT, 7.5)) << name;
        compass.take(name, calibration.value(name));
      }
      const auto measured_uT = compass.measured_uT(unit, sent_uT, 7.5);
      ASSERT_TRUE(measured_uT);
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR((*measured_uT)[axis], field_uT[static_cast<Eigen::Index>(axis)], 1e-9);
      EXPECT_FALSE(compass.measured_uT(unit, sent_uT, std::nullopt)) << "the current is absent";
      EXPECT_FALSE(compass.measured_uT((unit + 1) % AutopilotCompass::kUnits, sent_uT, 7.5));
    }
  }
}

TEST(AutopilotCompass, OneThatWasNeverCalibratedChangesNothing) {
  AutopilotCompass compass;
  for (const std::string& name : AutopilotCompass::names(0)) compass.take(name, 0);
  EXPECT_EQ(compass.measured_uT(0, {20, -3, 43}, std::nullopt), (Vector3{20, -3, 43}));
}

TEST(AutopilotCompass, CannotBeUndoneByTheThrottleOrWithoutAnInverse) {
  AutopilotCompass compass;
  for (const std::string& name : AutopilotCompass::names(0)) compass.take(name, 1);
  EXPECT_FALSE(compass.measured_uT(0, {20, -3, 43}, 1.0)) << "by the throttle, and D has no inverse";
  for (const char axis : {'X', 'Y', 'Z'}) compass.take(std::string("COMPASS_ODI_") + axis, 0);
  EXPECT_FALSE(compass.measured_uT(0, {20, -3, 43}, 1.0)) << "by the throttle";
  compass.take("COMPASS_MOTCT", 0);
  EXPECT_TRUE(compass.measured_uT(0, {20, -3, 43}, 1.0));
}

TEST(AutopilotCompass, OtherNamesAndNumbersAreIgnored) {
  AutopilotCompass compass;
  for (const std::string& name : AutopilotCompass::names(0)) compass.take(name, 0);
  for (const char* name : {"", "COMPASS_", "COMPASS_OFS_", "COMPASS_OFS_W", "COMPASS_OFS9_X", "COMPASS_X", "OFS_X",
                           "COMPASS_OFFS_MAX", "COMPASS_DEC", "COMPASS_DIA2_Y", "COMPASS_1", "COMPASS__X"})
    compass.take(name, 77);
  compass.take("COMPASS_OFS_X", std::numeric_limits<double>::infinity());
  EXPECT_EQ(compass.measured_uT(0, {20, -3, 43}, std::nullopt), (Vector3{20, -3, 43}));
}

}  // namespace
}  // namespace navcal::instruments
