// SPDX-License-Identifier: Apache-2.0
// An autopilot, with the parameters, makes of a field what the calibration makes of it.
#include "report/autopilot_parameters.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

namespace navcal::report {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

calib::Report report_of(const Eigen::Vector3d& offset_uT, const Eigen::Matrix3d& matrix, double z_std_uT) {
  calib::Report report;
  report.estimates.magnetometer = calib::FieldCorrection{offset_uT, matrix};
  calib::CalibratorReport iron;
  iron.calibrator = calib::Calibrator::magnetometer;
  iron.outcome = calib::Outcome::accepted;
  iron.estimate = {{"offset_x_uT", offset_uT.x(), 0.1},      {"offset_y_uT", offset_uT.y(), 0.1},
                   {"offset_z_uT", offset_uT.z(), z_std_uT}, {"matrix_xx", matrix(0, 0), 0.01},
                   {"matrix_yy", matrix(1, 1), 0.01},        {"matrix_zz", matrix(2, 2), z_std_uT},
                   {"matrix_xy", matrix(0, 1), 0.01},        {"matrix_xz", matrix(0, 2), z_std_uT},
                   {"matrix_yz", matrix(1, 2), z_std_uT}};
  report.calibrators.push_back(iron);
  return report;
}

/// Of lines "NAME,VALUE", or of QGroundControl's: vehicle, component, name, value, type.
std::map<std::string, double> values_of(const std::string& file) {
  std::map<std::string, double> values;
  std::istringstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    const bool has_columns = line.starts_with("1\t1\t");
    if (has_columns) {
      const std::string type = line.substr(line.rfind('\t') + 1);
      EXPECT_EQ(type, line.find("_TYP") == std::string::npos ? "9" : "6") << line;
      line = line.substr(4, line.rfind('\t') - 4);
    }
    const auto between = line.find(has_columns ? '\t' : ',');
    EXPECT_TRUE(values.emplace(line.substr(0, between), std::stod(line.substr(between + 1))).second) << line;
  }
  return values;
}

Eigen::Vector3d three(const std::map<std::string, double>& values, const std::string& kind) {
  return {values.at(kind + "_X"), values.at(kind + "_Y"), values.at(kind + "_Z")};
}

/// A calibration with a motor's field, and a field with a current.
struct DrawnCalibration {
  explicit DrawnCalibration(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
    offset_uT = 20 * vector();
    slope_uT_per_A = vector();
    const Eigen::Vector3d on = 0.1 * vector(), beside = 0.1 * vector();
    matrix.diagonal() += on;
    matrix(0, 1) = matrix(1, 0) = beside.x();
    matrix(0, 2) = matrix(2, 0) = beside.y();
    matrix(1, 2) = matrix(2, 1) = beside.z();
    measured_uT = 40 * vector();
    here_uT = matrix * (measured_uT - slope_uT_per_A * current_A - offset_uT);
  }
  [[nodiscard]] calib::Report report() const {
    calib::Report report = report_of(offset_uT, matrix, 0.2);
    report.estimates.motor_current = calib::MotorCurrentCorrection{slope_uT_per_A};
    calib::CalibratorReport motor;
    motor.calibrator = calib::Calibrator::motor_current;
    motor.outcome = calib::Outcome::accepted;
    report.calibrators.push_back(motor);
    return report;
  }
  Eigen::Vector3d offset_uT, slope_uT_per_A, measured_uT, here_uT;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  double current_A = 7;
};

Eigen::Matrix3d symmetric(const Eigen::Vector3d& on, const Eigen::Vector3d& beside) {
  Eigen::Matrix3d d;
  d << on.x(), beside.x(), beside.y(), beside.x(), on.y(), beside.z(), beside.y(), beside.z(), on.z();
  return d;
}

TEST(AutopilotParameters, AreTheSameCorrection) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const DrawnCalibration drawn(seed);
    const int unit = 1 + static_cast<int>(seed % 3);
    const auto values = values_of(autopilot_parameters(drawn.report(), unit, false));
    const std::string number = unit == 1 ? "" : std::to_string(unit);
    EXPECT_EQ(values.at("COMPASS_MOTCT"), 2);
    EXPECT_EQ(values.at("COMPASS_SCALE" + number), 1);
    const Eigen::Matrix3d d =
        symmetric(three(values, "COMPASS_DIA" + number), three(values, "COMPASS_ODI" + number));
    const Eigen::Vector3d there_mG = d * (10 * drawn.measured_uT + three(values, "COMPASS_OFS" + number)) +
                                     three(values, "COMPASS_MOT" + number) * drawn.current_A;
    EXPECT_LT((there_mG / 10 - drawn.here_uT).norm(), 0.05) << seed;
  }
}

// PX4's calibration::Magnetometer::Correct: rotation (scale ((data + power compensation) - offset)), in gauss,
// where power is the current in kA with CAL_MAG_COMP_TYP 2 (VehicleMagnetometer).
TEST(AutopilotParameters, OfPx4AreTheSameCorrection) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const DrawnCalibration drawn(seed);
    const int unit = 1 + static_cast<int>(seed % 3);
    const auto values = values_of(autopilot_parameters(drawn.report(), unit, true));
    EXPECT_EQ(values.size(), 13U);
    EXPECT_EQ(values.at("CAL_MAG_COMP_TYP"), 2);
    const auto of = [&](const std::string& kind) {
      const std::string slot = "CAL_MAG" + std::to_string(unit - 1) + "_";
      return Eigen::Vector3d(values.at(slot + "X" + kind), values.at(slot + "Y" + kind),
                             values.at(slot + "Z" + kind));
    };
    const double power_kA = drawn.current_A / 1000;
    const Eigen::Vector3d there_G =
        symmetric(of("SCALE"), of("ODIAG")) * ((drawn.measured_uT / 100 + power_kA * of("COMP")) - of("OFF"));
    EXPECT_LT((there_G * 100 - drawn.here_uT).norm(), 1e-3) << seed;
  }
}

TEST(AutopilotParameters, SayWhatTheyGainOnReadingsHeldOut) {
  calib::Report report = report_of({3, -4, 0}, Eigen::Matrix3d::Identity(), 0.1);
  EXPECT_EQ(autopilot_parameters(report, 1, false).find("held out"), std::string::npos);
  report.calibrators[0].judgement.held_out_quantity = calib::HeldOutQuantity::field;
  report.calibrators[0].judgement.held_out_before = 0.12;
  report.calibrators[0].judgement.held_out_after = 0.007;
  EXPECT_NE(
      autopilot_parameters(report, 1, false)
          .find("# Compass calibration for ArduPilot, in mGauss, made by navcal; on readings held out 12.00 -> "
                "0.70 % of the field's size\n"),
      std::string::npos);
}

TEST(AutopilotParameters, WhatIsNotDeterminedIsLeftOut) {
  const auto file = autopilot_parameters(report_of({3, -4, 0}, Eigen::Matrix3d::Identity(), kUnknown), 1, false);
  const auto values = values_of(file);
  EXPECT_EQ(values.at("COMPASS_OFS_X"), -30);
  EXPECT_EQ(values.at("COMPASS_OFS_Y"), 40);
  for (const char* vertical : {"COMPASS_OFS_Z", "COMPASS_DIA_Z", "COMPASS_ODI_Y", "COMPASS_ODI_Z"})
    EXPECT_FALSE(values.contains(vertical)) << vertical << '\n' << file;
  EXPECT_EQ(values.at("COMPASS_DIA_X"), 1);
  EXPECT_FALSE(values.contains("COMPASS_MOTCT")) << file;
  EXPECT_NE(file.find("COMPASS_OFS_Z was not determined"), std::string::npos) << file;
}

TEST(AutopilotParameters, WithoutAnAcceptedEstimateThereAreNone) {
  EXPECT_THROW((void)autopilot_parameters({}, 1, false), std::invalid_argument);
  calib::Report report = report_of({3, -4, 0}, Eigen::Matrix3d::Identity(), 0.1);
  report.calibrators[0].outcome = calib::Outcome::no_better;
  EXPECT_THROW((void)autopilot_parameters(report, 1, true), std::invalid_argument);
}

}  // namespace
}  // namespace navcal::report
