// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calib/magnetometer/ellipse_shape.h"
#include "calib/magnetometer/field_cells.h"

namespace navcal::calib {

/// Levelled field, and what a vertical offset of one uT adds to it: see vertical_in_level().
using EllipseCells = std::vector<FieldCells<2, 4>::Cell>;

/// Ellipse of least orthogonal distance from the readings in cells.
struct EllipseFit {
  EllipseShape shape;
  EllipseShape::Matrix covariance = EllipseShape::Matrix::Zero();  ///< by the scatter of single readings
  double residual_uT = 0;  ///< standard deviation of one reading about the ellipse
  double misfit = 1;       ///< mean square of sectors' mean distances over what the scatter explains
  double damping = 0;      ///< Marquardt's
  bool settled = false;    ///< the last iteration moved nothing
  void archive(Archive& archive) { archive(shape, covariance, residual_uT, misfit, damping, settled); }
};

/// Taubin's ellipse, a circle where that is none; nullopt: a point or a straight line.
[[nodiscard]] std::optional<EllipseShape> taubin_ellipse(const EllipseCells& cells);

/// One iteration of Gauss-Newton. `noise_uT`: as believed before, worth twenty readings.
[[nodiscard]] EllipseFit improve(const EllipseFit& fit, const EllipseCells& cells, double noise_uT);

/// Signed orthogonal distance of a cell's readings, on the mean, with the arc within the cell taken into account.
[[nodiscard]] double mean_distance_uT(const EllipseShape& shape, const EllipseCells::value_type& cell);

}  // namespace navcal::calib
