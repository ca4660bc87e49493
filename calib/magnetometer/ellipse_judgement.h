// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calib/magnetometer/ellipse_fit.h"
#include "calib/magnetometer/magnetometer_estimate.h"

namespace navcal::calib {

/// Covariance of a fit with all that is off beside the scatter of readings: the misfit of sectors of ten degrees
/// of heading, the vertical offset, of which each tilt brings a share into the level, and `model_error_uT` of each
/// sector that no number of readings averages away (iron that moves, a field that is not uniform).
[[nodiscard]] EllipseShape::Matrix stated_covariance(const EllipseFit& fit, const EllipseCells& cells,
                                                     double model_error_uT);

/// The estimate by an ellipse: of the vertical nothing is determined.
[[nodiscard]] MagnetometerEstimate level_estimate(const EllipseShape& shape,
                                                  const EllipseShape::Matrix& covariance, double residual_uT,
                                                  std::uint64_t samples);

/// Growth of the squared distances two standard deviations from the fit in its least certain direction,
/// relative to the growth of a parabola (four times the variance); the larger of both sides, >= 1. Large: the
/// likelihood is so curved that the covariance is meaningless.
[[nodiscard]] double curvature_of(const EllipseFit& fit, const EllipseCells& cells);

/// Condition of the information on the parameters, each scaled to unit variance.
template <int N>
[[nodiscard]] double condition_of(const Eigen::Matrix<double, N, N>& covariance);
extern template double condition_of(const Eigen::Matrix<double, 5, 5>&);
extern template double condition_of(const Eigen::Matrix<double, 7, 7>&);
extern template double condition_of(const Eigen::Matrix<double, 10, 10>&);

}  // namespace navcal::calib
