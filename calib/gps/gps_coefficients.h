// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "calib/gps/gps_summary.h"

namespace navcal::calib {

/// Model: C_jm = s (k - k0)^j / j! times the m-th Fourier coefficient of e^{i (d - E(psi))}: what the unknowns of
/// GpsCompass (A..E in rad, speed scale s, slip k in s, current in m/s) mean for the linear coefficients of
/// GpsSummary, with the derivatives by each unknown.
struct GpsCoefficients {
  static constexpr int kUnknowns = 9;
  enum Unknown : int { kOffset = 0, kSpeedScale = 5, kSlip = 6, kNorth = 7, kEast = 8 };
  using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
  using Jacobian = Eigen::Matrix<GpsSummary::Complex, GpsSummary::kTerms, kUnknowns>;

  /// `declination_rad`: d; `expansion_slip_s`: k0.
  GpsCoefficients(const Unknowns& unknowns, double declination_rad, double expansion_slip_s);

  GpsSummary::Terms value = GpsSummary::Terms::Zero();
  Jacobian slope = Jacobian::Zero();
};

/// 1, sin, cos, sin 2, cos 2: what A..E are the coefficients of (2.7).
[[nodiscard]] Eigen::Matrix<double, 5, 1> deviation_harmonics(double heading_rad);

}  // namespace navcal::calib
