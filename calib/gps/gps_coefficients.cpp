// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/gps_coefficients.h"

#include <cmath>
#include <numbers>

namespace navcal::calib {
namespace {

constexpr int kPoints = 32;  // of the transform: harmonics above the 25th would fold back, there are none

}  // namespace

Eigen::Matrix<double, 5, 1> deviation_harmonics(double heading_rad) {
  return {1, std::sin(heading_rad), std::cos(heading_rad), std::sin(2 * heading_rad), std::cos(2 * heading_rad)};
}

GpsCoefficients::GpsCoefficients(const Unknowns& unknowns, double declination_rad, double expansion_slip_s) {
  using Complex = GpsSummary::Complex;
  constexpr int kModes = GpsSummary::kModes;
  Eigen::Matrix<Complex, kModes, 1> mode = Eigen::Matrix<Complex, kModes, 1>::Zero();
  Eigen::Matrix<Complex, kModes, 5> mode_slope = Eigen::Matrix<Complex, kModes, 5>::Zero();
  for (int point = 0; point < kPoints; ++point) {
    const double heading_rad = 2 * std::numbers::pi * point / kPoints;
    const auto harmonics = deviation_harmonics(heading_rad);
    const double angle_rad = declination_rad - unknowns.head<5>().dot(harmonics);
    for (int m = 0; m < kModes; ++m) {
      const Complex share = std::polar(1.0 / kPoints, angle_rad - (m - GpsSummary::kHarmonics) * heading_rad);
      mode[m] += share;
      mode_slope.row(m) += share * Complex(0, -1) * harmonics.transpose();
    }
  }
  const double slip_s = unknowns[kSlip] - expansion_slip_s;
  double power = 1, power_slope = 0;  // slip^j / j! and its derivative
  for (int j = 0; j < GpsSummary::kSlipTerms; ++j) {
    const int first = j * kModes;
    value.segment<kModes>(first) = unknowns[kSpeedScale] * power * mode;
    slope.block<kModes, 5>(first, kOffset) = unknowns[kSpeedScale] * power * mode_slope;
    slope.block<kModes, 1>(first, kSpeedScale) = power * mode;
    slope.block<kModes, 1>(first, kSlip) = unknowns[kSpeedScale] * power_slope * mode;
    power_slope = power;
    power *= slip_s / (j + 1);
  }
  constexpr int kCurrent = GpsSummary::kTerms - 1;
  value[kCurrent] = {unknowns[kNorth], unknowns[kEast]};
  slope(kCurrent, kNorth) = 1;
  slope(kCurrent, kEast) = Complex(0, 1);
}

}  // namespace navcal::calib
