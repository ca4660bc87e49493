// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

namespace navcal::calib::thesis {

/// Model: psi = psi_m - E(psi_m), E = B sin psi_m + C cos psi_m + D sin 2 psi_m + E cos 2 psi_m (2.7, 2.8); from
/// the first reading on, sum of h r - [psi_m(k+n) - psi_m(k)] = G q (4.6), solved by least squares (4.7). Radians.
/// As in Mach 2003, for comparison: forward Euler, a gyro without error, all rows hang on the first heading.
class CompassLeastSquares {
 public:
  explicit CompassLeastSquares(double period_s) : period_s_(period_s) {}

  /// `measured_heading_rad` unwrapped; `heading_rate_rad_s` r of (3.1), by the calibrated gyro.
  void update(double measured_heading_rad, double heading_rate_rad_s);
  /// q = (B, C, D, E) in radians; nothing where G'G is singular.
  [[nodiscard]] std::optional<Eigen::Vector4d> estimate() const;

 private:
  double period_s_;
  std::optional<double> first_heading_rad_;
  double turned_rad_ = 0;
  Eigen::Matrix4d normal_ = Eigen::Matrix4d::Zero();
  Eigen::Vector4d projected_ = Eigen::Vector4d::Zero();
};

}  // namespace navcal::calib::thesis
