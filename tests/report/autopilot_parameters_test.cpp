// SPDX-License-Identifier: Apache-2.0
// ArduPilot, with the parameters, makes of a field what the calibration makes of it.
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

std::map<std::string, double> values_of(const std::string& file) {
  std::map<std::string, double> values;
  std::istringstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto comma = line.find(',');
    EXPECT_TRUE(values.emplace(line.substr(0, comma), std::stod(line.substr(comma + 1))).second) << line;
  }
  return values;
}

Eigen::Vector3d three(const std::map<std::string, double>& values, const std::string& kind) {
  return {values.at(kind + "_X"), values.at(kind + "_Y"), values.at(kind + "_Z")};
}

TEST(AutopilotParameters, AreTheSameCorrection) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  for (int unit = 1; unit <= 3; ++unit) {
    const Eigen::Vector3d offset_uT = 20 * vector(), slope_uT_per_A = vector();
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    const Eigen::Vector3d on = 0.1 * vector(), beside = 0.1 * vector();
    matrix.diagonal() += on;
    matrix(0, 1) = matrix(1, 0) = beside.x();
    matrix(0, 2) = matrix(2, 0) = beside.y();
    matrix(1, 2) = matrix(2, 1) = beside.z();
    calib::Report report = report_of(offset_uT, matrix, 0.2);
    report.estimates.motor_current = calib::MotorCurrentCorrection{slope_uT_per_A};
    calib::CalibratorReport motor;
    motor.calibrator = calib::Calibrator::motor_current;
    motor.outcome = calib::Outcome::accepted;
    report.calibrators.push_back(motor);

    const auto values = values_of(autopilot_parameters(report, unit));
    const std::string number = unit == 1 ? "" : std::to_string(unit);
    EXPECT_EQ(values.at("COMPASS_MOTCT"), 2);
    EXPECT_EQ(values.at("COMPASS_SCALE" + number), 1);
    const Eigen::Vector3d ofs = three(values, "COMPASS_OFS" + number), dia = three(values, "COMPASS_DIA" + number),
                          odi = three(values, "COMPASS_ODI" + number), mot = three(values, "COMPASS_MOT" + number);
    Eigen::Matrix3d d;
    d << dia.x(), odi.x(), odi.y(), odi.x(), dia.y(), odi.z(), odi.y(), odi.z(), dia.z();
    const Eigen::Vector3d measured_uT = 40 * vector();
    const double current_A = 7;
    const Eigen::Vector3d here_uT = matrix * (measured_uT - slope_uT_per_A * current_A - offset_uT);
    const Eigen::Vector3d there_mG = d * (10 * measured_uT + ofs) + mot * current_A;
    EXPECT_LT((there_mG / 10 - here_uT).norm(), 0.02) << unit;
  }
}

TEST(AutopilotParameters, WhatIsNotDeterminedIsLeftOut) {
  const auto file = autopilot_parameters(report_of({3, -4, 0}, Eigen::Matrix3d::Identity(), kUnknown), 1);
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
  EXPECT_THROW((void)autopilot_parameters({}, 1), std::invalid_argument);
  calib::Report report = report_of({3, -4, 0}, Eigen::Matrix3d::Identity(), 0.1);
  report.calibrators[0].outcome = calib::Outcome::no_better;
  EXPECT_THROW((void)autopilot_parameters(report, 1), std::invalid_argument);
}

}  // namespace
}  // namespace navcal::report
