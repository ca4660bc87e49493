// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

namespace navcal::calib::thesis {

/// Model: r = cos(phi)/cos(theta) (abar omega_m + bbar), r the heading rate (3.1); psi(k+n) - psi(k) = abar G1 +
/// bbar G2 with G the sums by forward Euler (3.3), solved by least squares (3.5). Radians, rad/s. As in Mach 2003,
/// for comparison: the compass is taken as true, the pitch rate is neglected, all rows hang on the first heading.
class GyroLeastSquares {
 public:
  explicit GyroLeastSquares(double period_s) : period_s_(period_s) {}

  /// `heading_rad` unwrapped.
  void update(double heading_rad, double roll_rad, double pitch_rad, double measured_rate_rad_s);
  /// (abar, bbar); nothing where G'G is singular, as without a change of rate.
  [[nodiscard]] std::optional<Eigen::Vector2d> estimate() const;

 private:
  double period_s_;
  std::optional<double> first_heading_rad_;
  Eigen::Vector2d row_ = Eigen::Vector2d::Zero();        ///< G_n
  Eigen::Matrix2d normal_ = Eigen::Matrix2d::Zero();     ///< G'G
  Eigen::Vector2d projected_ = Eigen::Vector2d::Zero();  ///< G'z
};

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
