// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "calib/magnetometer/ellipsoid_fit.h"
#include "calib/magnetometer/ellipsoid_shape.h"

namespace navcal::calib {

/// Noise of the readings, with what no reading has told yet.
struct SegmentNoise {
  double field_uT = 0.15;        ///< of one reading
  double tilt_rad = 0.01;        ///< of one reading
  double model_uT = 0.12;        ///< unmodelled, of every cell
  double tilt_error_rad = 0.02;  ///< unmodelled, of every cell: lag, accelerations, mounting of the inclinometer
};

/// Prior before any reading: hard iron of up to some hundred uT, any field of the Earth, soft iron of a tenth.
/// Directions that no reading determines keep the variance of this prior, so that a prediction there states its
/// full uncertainty.
struct SegmentBelief {
  double centre_std_uT = 100;
  double field_uT = 40, field_std = 0.35;  ///< relative
  double soft_iron_std = 0.12;
  double sine_of_dip = 0, sine_of_dip_std = 0.7;

  /// Prior from what is known of the field. The scatter of soft iron does not depend on it.
  [[nodiscard]] static SegmentBelief about(const std::optional<KnownField>& known);
};

/// Model: readings of several segments of time that differ in the hard iron alone: |M (m - c_k)| = 1 and
/// down' M (m - c_k) = sine of dip, k the segment (EllipsoidShape).
struct SegmentsFit {
  EllipsoidShape shape;  ///< with the centre of the first segment
  std::vector<Eigen::Vector3d> centres_uT;
  /// Covariance of the ten parameters of `shape`, followed by three for the centre of each further segment.
  Eigen::MatrixXd covariance;
  double cost = 0;         ///< squared residuals in units of their variance, with those of the belief
  bool converged = false;  ///< the last iteration gained nothing
};

using Segments = std::span<const EllipsoidCells* const>;

/// Maximum a posteriori, by Gauss-Newton with Marquardt's damping; nullopt: too few readings to begin.
[[nodiscard]] std::optional<SegmentsFit> fit_segments(Segments segments, const SegmentNoise& noise,
                                                      const SegmentBelief& belief,
                                                      const EllipsoidShape* begin = nullptr);

/// Departure of a cell from a shape: of the size, and of the sine of dip where the tilt is known.
struct SegmentResidual {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix2d variance = Eigen::Matrix2d::Identity();  ///< of `value` by noise and unmodelled errors
  Eigen::Matrix<double, 2, EllipsoidShape::kParameters> slope =
      Eigen::Matrix<double, 2, EllipsoidShape::kParameters>::Zero();
  int freedom = 2;  ///< 1: the tilt is not known

  /// Squared departure in units of its variance and of what the parameters' `covariance` adds to it.
  [[nodiscard]] double square(const EllipsoidShape::Matrix& covariance) const;
  [[nodiscard]] double square() const;
};
[[nodiscard]] SegmentResidual segment_residual(const EllipsoidShape& shape, const FieldCells<3, 6>::Cell& cell,
                                               const SegmentNoise& noise);
/// The same for a single reading that may be far off. Its slopes are taken at the nearest field that the shape
/// predicts, because at the reading itself an error of scale would excuse any departure.
[[nodiscard]] SegmentResidual predicted_residual(const EllipsoidShape& shape,
                                                 const FieldCells<3, 6>::Cell& reading, const SegmentNoise& noise);

/// Mean and standard deviation of |matrix (m - centre)| over the readings of the cells, in units of 1.
struct SizeSpread {
  double mean = 0, std = 0;
};
[[nodiscard]] SizeSpread spread_of(const EllipsoidCells& cells, const Eigen::Matrix3d& matrix,
                                   const Eigen::Vector3d& centre_uT);

}  // namespace navcal::calib
