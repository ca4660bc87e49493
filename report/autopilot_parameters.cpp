// SPDX-License-Identifier: Apache-2.0
#include "report/autopilot_parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace navcal::report {
namespace {

constexpr double kMilliGaussPerMicrotesla = 10;

}  // namespace

std::string autopilot_parameters(const calib::Report& report, int unit) {
  const calib::CalibratorReport* const iron = report.find(calib::Calibrator::magnetometer);
  const auto& field = report.estimates.magnetometer;
  if (iron == nullptr || !field) throw std::invalid_argument("there is no estimate of hard and soft iron");
  if (iron->outcome != calib::Outcome::accepted)
    throw std::invalid_argument(fmt::format("the estimate of hard and soft iron is {}{}{}",
                                            calib::name_of(iron->outcome),
                                            iron->judgement.reason.empty() ? "" : ": ", iron->judgement.reason));
  const auto is_determined = [&](std::string_view name) {
    const calib::Quantity* const quantity = iron->quantity(name);
    return quantity != nullptr && std::isfinite(quantity->value) && std::isfinite(quantity->std);
  };
  const std::string number = unit == 1 ? "" : std::to_string(unit);
  std::string lines = "# Compass calibration for ArduPilot, made by navcal; fields in mGauss\n", left;
  const auto add = [&](std::string_view kind, char axis, double value) {
    lines += fmt::format("COMPASS_{}{}_{},{:.4f}\n", kind, number, axis, value);
  };
  const auto add_determined = [&](std::string_view kind, char axis, std::string_view quantity, double value) {
    if (is_determined(quantity)) return add(kind, axis, value);
    left += fmt::format("# COMPASS_{}{}_{} was not determined, and stays as it is\n", kind, number, axis);
  };
  const Eigen::Vector3d offset_mG = -field->offset_uT * kMilliGaussPerMicrotesla;
  const Eigen::Matrix3d& matrix = field->matrix;
  add_determined("OFS", 'X', "offset_x_uT", offset_mG.x());
  add_determined("OFS", 'Y', "offset_y_uT", offset_mG.y());
  add_determined("OFS", 'Z', "offset_z_uT", offset_mG.z());
  add_determined("DIA", 'X', "matrix_xx", matrix(0, 0));
  add_determined("DIA", 'Y', "matrix_yy", matrix(1, 1));
  add_determined("DIA", 'Z', "matrix_zz", matrix(2, 2));
  add_determined("ODI", 'X', "matrix_xy", matrix(0, 1));
  add_determined("ODI", 'Y', "matrix_xz", matrix(0, 2));
  add_determined("ODI", 'Z', "matrix_yz", matrix(1, 2));
  lines += fmt::format("COMPASS_SCALE{},1\n", number);
  const calib::CalibratorReport* const motor = report.find(calib::Calibrator::motor_current);
  if (motor != nullptr && motor->outcome == calib::Outcome::accepted && report.estimates.motor_current) {
    const Eigen::Vector3d added =
        -(matrix * report.estimates.motor_current->slope_uT_per_A) * kMilliGaussPerMicrotesla;
    lines += "# The motor's field goes by the current of the first battery\nCOMPASS_MOTCT,2\n";
    add("MOT", 'X', added.x());
    add("MOT", 'Y', added.y());
    add("MOT", 'Z', added.z());
  }
  return lines + left;
}

}  // namespace navcal::report
