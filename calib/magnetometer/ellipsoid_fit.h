// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/magnetometer/ellipsoid_shape.h"
#include "calib/magnetometer/field_cells.h"
#include "calib/magnetometer/magnetometer_estimate.h"

namespace navcal::calib {

using EllipsoidCells = std::vector<FieldCells<3, 6>::Cell>;

/// Noise of one reading. The inflations say by how much the variance of a mean of readings exceeds that of so many
/// independent ones, because neighbours err together.
struct EllipsoidNoise {
  double field_uT = 0.15;
  double tilt_rad = 0.002;
  double field_inflation = 1, tilt_inflation = 1;
  void archive(Archive& archive) { archive(field_uT, tilt_rad, field_inflation, tilt_inflation); }
};

/// Prior of the fit: size and dip of the field where known, and the scatter of soft iron.
struct EllipsoidPrior {
  std::optional<KnownField> known;
  double soft_iron_std = 0.15;
};

struct EllipsoidFit {
  EllipsoidShape shape;
  EllipsoidShape::Matrix covariance = EllipsoidShape::Matrix::Zero();  ///< with the prior
  double damping = 0;                                                  ///< Marquardt's
  bool settled = false;                                                ///< the last iteration moved nothing
  void archive(Archive& archive) { archive(shape, covariance, damping, settled); }
};

/// Sphere with gravity, by linear least squares; nullopt: all readings in one point.
[[nodiscard]] std::optional<EllipsoidShape> starting_sphere(const EllipsoidCells& cells,
                                                            const EllipsoidPrior& prior);

/// One iteration of Gauss-Newton.
[[nodiscard]] EllipsoidFit improve(const EllipsoidFit& fit, const EllipsoidCells& cells,
                                   const EllipsoidNoise& noise, const EllipsoidPrior& prior);

}  // namespace navcal::calib
