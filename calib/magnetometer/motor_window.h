// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "calib/archive.h"

namespace navcal::calib {

/// A reading of the field with what the gyros and the motor card say of its time.
struct MotorFieldReading {
  double time_s = 0;
  Eigen::Vector3d field_body_uT = Eigen::Vector3d::Zero();
  Eigen::Vector4d turned = {0, 0, 0, 1};  ///< quaternion (x, y, z, w): from the segment's axes to body axes
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
  double current_A = 0;
  void archive(Archive& archive) { archive(time_s, field_body_uT, turned, rate_rad_s, current_A); }
};

struct MotorWindowNoise {
  double field_uT = 0.2;            ///< standard deviation of a field value
  double rate_rad_sqrt_s = 0.0004;  ///< density of the gyros' noise
};

/// Evidence of one window on x = (k, h): k is the field per ampere in body axes (uT/A), h the hard iron (uT),
/// which all windows have in common. The misfit of its readings, minimised over all other unknowns, is rest +
/// (x - best)' information (x - best) in units of the variance, for `information * best = vector`.
struct MotorFieldEvidence {
  using Information = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  /// Standard deviation of hard iron before any reading, uT.
  static constexpr double kHardIron_uT = 60;

  Information information = Information::Zero();  ///< A2/uT2, A/uT2, 1/uT2
  Vector vector = Vector::Zero();                 ///< A/uT, 1/uT
  double square = 0;                              ///< of the misfit for x = 0, in units of the variance
  double values = 0;                              ///< number of field values
  double freedom = 0;                             ///< number of components of x that it determines
  double variance_uT2 = 0;                        ///< of a field value, as the window itself shows it

  /// Mean square of the misfit of a field value, for a field per ampere of `k` and whatever hard iron fits best.
  [[nodiscard]] double mean_square_uT2(const Eigen::Vector3d& k_uT_per_A) const;
  void archive(Archive& archive) { archive(information, vector, square, values, freedom, variance_uT2); }
};

/// Model: m_i = (1 + D) (u_i + u_i x d_i + tau w_i x u_i) + h + k I_i + noise, for the readings i of a window.
/// u_i = R_i b is the field b of the window's beginning, turned by the gyros; d_i the angle that the gyros miss by
/// an unknown bias of each axis and an unknown scale of the yaw gyro; tau the delay of the field against the
/// gyros; h hard iron, D soft iron. All of b, D, bias, scale and tau are nuisance parameters of this window alone,
/// with wide Gaussian priors, and are marginalised: k and h follow only from what none of them can imitate. So
/// neither a steady current nor a turn is taken for the motor's field. The product of b with the others is
/// linearised and iterated (Gauss-Newton). The gyros' noise lets b walk within the window (Kalman filter). Where
/// residuals are larger than the noise says, the evidence is weakened accordingly.
///
/// Where a window hardly turns or tilts, the gyros' noise alone would seem to tell h from b: a constant fits
/// better than a field turned by noise. Of such a window the evidence about h itself is dropped. What it says of k
/// for any given h is kept, and h comes from the windows that turn.
[[nodiscard]] MotorFieldEvidence evidence_of(const std::vector<MotorFieldReading>& window,
                                             const MotorWindowNoise& noise);

}  // namespace navcal::calib
