// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/archive.h"
#include "calib/magnetometer/ellipse_shape.h"

namespace navcal::calib {

/// Mean of neighbouring readings, less than two degrees apart, with the sums of TurnStep from the beginning of the
/// segment to that mean.
struct TurnGroup {
  double count = 0;
  Eigen::Vector2d field_uT = Eigen::Vector2d::Zero();
  bool begins_segment = true;
  double time_s = 0, measured_angle_rad = 0, bias_time_s = 0, tilt_angle_rad = 0;
  Eigen::Vector2d vertical = Eigen::Vector2d::Zero();  ///< vertical_in_level()
  void archive(Archive& archive);
};

/// Scale and bias of the gyro, true rate = scale * measured + bias, as believed beforehand.
struct GyroBelief {
  Eigen::Vector2d mean{1, 0};  ///< scale; bias in rad/s
  Eigen::Matrix2d covariance = Eigen::Vector2d(0.04, 0.04).asDiagonal();
  void archive(Archive& archive) { archive(mean, covariance); }
};

struct ChainNoise {
  double field_uT = 0.15;
  double rate_rad_sqrt_s = 0.0016;
};

/// Ellipse, gyro and the heading of every group: the unknowns of EllipseGyro, which has the model.
struct EllipseChain {
  static constexpr int kUnknowns = EllipseShape::kParameters + 2;  ///< shape, scale, bias
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

  EllipseShape shape;
  Eigen::Vector2d gyro{1, 0};
  std::vector<double> headings_rad;
  Matrix covariance = Matrix::Zero();
  double residual_uT = 0;  ///< standard deviation of one reading
  double misfit = 1;       ///< sum of squares over its degrees of freedom: 1 when the noise is as stated
  double damping = 0;      ///< Marquardt's
  bool settled = false;    ///< the last iteration moved nothing

  void archive(Archive& archive) {
    archive(shape, gyro, headings_rad, covariance, residual_uT, misfit, damping, settled);
  }
};

/// A beginning that depends on the groups alone: Taubin's ellipse, from which the gyro follows, or the believed
/// gyro, from which the ellipse follows, whichever fits better. False: neither exists.
[[nodiscard]] bool start(EllipseChain& chain, const std::vector<TurnGroup>& groups, const GyroBelief& belief);

/// One iteration of Gauss-Newton: the headings, a chain, are eliminated one after the other, then the rest is
/// solved, then they are put back (Golub and Van Loan, Matrix Computations, 4.3).
void improve(EllipseChain& chain, const std::vector<TurnGroup>& groups, const GyroBelief& belief,
             const ChainNoise& noise);

/// Sum of squares in units of its variance.
[[nodiscard]] double cost_of(const EllipseChain& chain, const std::vector<TurnGroup>& groups,
                             const GyroBelief& belief, const ChainNoise& noise);

/// The turn from one group to the next of the same segment, and its derivatives by scale and bias.
[[nodiscard]] double turn_rad(const TurnGroup& from, const TurnGroup& to, const Eigen::Vector2d& gyro);

}  // namespace navcal::calib
