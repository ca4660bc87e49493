#pragma once

#include "calib/ellipsoid_fit.h"

namespace navcal::calib {

/// Covariance of a fit if, beside the noise of readings (`field_uT`), all of one direction of the field are off by
/// `model_error` of its size, which no number of readings averages away.
[[nodiscard]] EllipsoidShape::Matrix doubtful_covariance(const EllipsoidFit& fit, const EllipsoidCells& cells,
                                                         double field_uT, double model_error);

}  // namespace navcal::calib
