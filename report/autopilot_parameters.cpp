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
  constexpr std::string_view kAxes = "XYZ", kLower = "xyz";
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    if (is_determined(fmt::format("offset_{}_uT", kLower[axis])))
      add("OFS", kAxes[axis], -field->offset_uT[i] * kMilliGaussPerMicrotesla);
    else
      left += fmt::format("# COMPASS_OFS{}_{} was not determined, and stays as it is\n", number, kAxes[axis]);
  }
  const Eigen::Matrix3d& matrix = field->matrix;
  for (Eigen::Index i = 0; i < 3; ++i) add("DIA", kAxes[static_cast<std::size_t>(i)], matrix(i, i));
  add("ODI", 'X', matrix(0, 1));
  add("ODI", 'Y', matrix(0, 2));
  add("ODI", 'Z', matrix(1, 2));
  lines += fmt::format("COMPASS_SCALE{},1\n", number);
  const calib::CalibratorReport* const motor = report.find(calib::Calibrator::motor_current);
  if (motor != nullptr && motor->outcome == calib::Outcome::accepted && report.estimates.motor_current) {
    const Eigen::Vector3d added =
        -(matrix * report.estimates.motor_current->slope_uT_per_A) * kMilliGaussPerMicrotesla;
    lines += "# The motor's field goes by the current of the first battery\nCOMPASS_MOTCT,2\n";
    for (Eigen::Index i = 0; i < 3; ++i) add("MOT", kAxes[static_cast<std::size_t>(i)], added[i]);
  }
  return lines + left;
}

}  // namespace navcal::report
