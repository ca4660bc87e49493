// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/LU>

#include "calib/magnetometer/ellipsoid_fit.h"

namespace navcal::calib {

/// Residuals of a cell's readings in the two lines of the model: size of the field, and dip.
struct EllipsoidResidual {
  Eigen::Vector2d value;                 ///< on the mean of the cell's readings
  Eigen::Matrix2d noise;                 ///< of one reading; over the count it is that of their mean
  Eigen::Matrix<double, 2, 3> by_field;  ///< derivative of the value
  double tilt2 = 0;                      ///< variance of one reading's tilt, rad2
  bool tilt_known = false;

  /// Squared distance in units of the variance of one reading.
  [[nodiscard]] double square() const { return value.dot(noise.inverse() * value); }
};

using EllipsoidRows = Eigen::Matrix<double, 2, EllipsoidShape::kParameters>;

[[nodiscard]] EllipsoidResidual residual_of(const EllipsoidShape& shape, const EllipsoidCells::value_type& cell,
                                            const EllipsoidNoise& noise);

/// Derivative of the value by the parameters, at the reading less that part of its noise which the residual
/// reveals: slopes that vary with the noise they are multiplied with would take a small tilt, with noise, for a
/// larger one, and shift the centre.
[[nodiscard]] EllipsoidRows slope_of(const EllipsoidShape& shape, const EllipsoidCells::value_type& cell,
                                     const EllipsoidNoise& noise, const EllipsoidResidual& residual);

/// Weight and cost of a squared distance: beyond six standard deviations of one reading it grows as a logarithm.
[[nodiscard]] double outlier_weight(double square);
[[nodiscard]] double outlier_cost(double square);

}  // namespace navcal::calib
