// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

namespace navcal::calib {

/// Scale and bias of a yaw gyro, true rate = scale * measured + bias (2.12), and the deviation B, C, D, E of a
/// compass, psi = psi_m - A - f4(psi_m)'q (2.7, 2.8); rad/s and radians. A is in no turn: it stays in the heading.
using TurnCoefficients = Eigen::Matrix<double, 6, 1>;
using TurnCovariance = Eigen::Matrix<double, 6, 6>;
enum TurnCoefficient : int { kScale, kBias, kB, kC, kD, kE };

/// Prior of the coefficients. A variance of zero fixes a coefficient: a compass without error, or a gyro that
/// is known exactly. The covariance of an earlier gyro calibration serves as prior of the gyro.
struct TurnPrior {
  TurnCoefficients mean = TurnCoefficients::Unit(kScale);
  TurnCovariance covariance = TurnCovariance::Zero();
  std::array<bool, 6> sought{};  ///< those that are to be found: loose, and not correlated with any other

  /// The compass has no error, the gyro is unknown (THESIS chapter 3).
  [[nodiscard]] static TurnPrior unknown_gyro();
  /// The gyro is known, the compass is not (section 4.2); the covariance that of (scale, bias).
  [[nodiscard]] static TurnPrior unknown_compass(double scale, double bias_rad_s,
                                                 const Eigen::Matrix2d& gyro_covariance);
  /// Neither is known (the thesis's major problem, THESIS 11.3).
  [[nodiscard]] static TurnPrior unknown_both();
};

}  // namespace navcal::calib
