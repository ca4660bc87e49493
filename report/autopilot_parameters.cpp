// SPDX-License-Identifier: Apache-2.0
#include "report/autopilot_parameters.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "report/calibrate_words.h"

namespace navcal::report {
namespace {

using NamesOfAxes = std::array<std::string_view, 3>;

/// Kinds of parameters in the order of the formula, and the quantities that determine the first three.
constexpr std::array kKindsOfArduPilot{"OFS", "DIA", "ODI", "MOT"}, kKindsOfPx4{"OFF", "SCALE", "ODIAG", "COMP"};
constexpr std::array kQuantities{NamesOfAxes{"offset_x_uT", "offset_y_uT", "offset_z_uT"},
                                 NamesOfAxes{"matrix_xx", "matrix_yy", "matrix_zz"},
                                 NamesOfAxes{"matrix_xy", "matrix_xz", "matrix_yz"}};

}  // namespace

std::string autopilot_parameters(const calib::Report& report, int unit, bool is_px4) {
  const calib::CalibratorReport* const iron = report.find(calib::Calibrator::magnetometer);
  const auto& field = report.estimates.magnetometer;
  if (iron == nullptr || !field) throw std::invalid_argument("there is no estimate of hard and soft iron");
  if (iron->outcome != calib::Outcome::accepted)
    throw std::invalid_argument(fmt::format("the estimate of hard and soft iron is {}{}{}",
                                            calib::name_of(iron->outcome),
                                            iron->judgement.reason.empty() ? "" : ": ", iron->judgement.reason));
  const std::string number = unit == 1 ? "" : std::to_string(unit);
  const std::string gain = held_out_of(*iron, "->");
  std::string lines = fmt::format("# Compass calibration for {}, made by navcal{}{}\n",
                                  is_px4 ? "PX4, in gauss" : "ArduPilot, in mGauss",
                                  gain.empty() ? "" : "; on readings held out ", gain);
  std::string left;
  const auto add = [&](std::size_t kind, const Eigen::Vector3d& values) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = values[static_cast<Eigen::Index>(axis)];
      const std::string name = is_px4
                                   ? fmt::format("CAL_MAG{}_{}{}", unit - 1, "XYZ"[axis], kKindsOfPx4[kind])
                                   : fmt::format("COMPASS_{}{}_{}", kKindsOfArduPilot[kind], number, "XYZ"[axis]);
      const calib::Quantity* const of =
          kind < kQuantities.size() ? iron->quantity(kQuantities[kind][axis]) : nullptr;
      const bool is_determined =
          kind == kQuantities.size() || (of != nullptr && std::isfinite(of->value) && std::isfinite(of->std));
      if (!is_determined)
        left += fmt::format("# {} was not determined, and stays as it is\n", name);
      else if (is_px4)
        lines += fmt::format("1\t1\t{}\t{:.7f}\t9\n", name, value);
      else
        lines += fmt::format("{},{:.4f}\n", name, value);
    }
  };
  constexpr double kMilliGaussPerMicrotesla = 10, kGaussPerMicrotesla = 0.01;
  const Eigen::Matrix3d& matrix = field->matrix;
  add(0, field->offset_uT * (is_px4 ? kGaussPerMicrotesla : -kMilliGaussPerMicrotesla));
  add(1, matrix.diagonal());
  add(2, {matrix(0, 1), matrix(0, 2), matrix(1, 2)});
  if (!is_px4) lines += fmt::format("COMPASS_SCALE{},1\n", number);
  const calib::CalibratorReport* const motor = report.find(calib::Calibrator::motor_current);
  if (motor != nullptr && motor->outcome == calib::Outcome::accepted && report.estimates.motor_current) {
    const Eigen::Vector3d& slope_uT_per_A = report.estimates.motor_current->slope_uT_per_A;
    lines += "# The motor's field goes by the current of the first battery\n";
    lines += is_px4 ? "1\t1\tCAL_MAG_COMP_TYP\t2\t6\n" : "COMPASS_MOTCT,2\n";
    if (is_px4)
      add(3, slope_uT_per_A * -1000 * kGaussPerMicrotesla);  // per kA
    else
      add(3, -(matrix * slope_uT_per_A) * kMilliGaussPerMicrotesla);
  }
  return lines + left;
}

}  // namespace navcal::report
