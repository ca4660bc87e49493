// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calib/magnetometer/ellipsoid_fit.h"

namespace navcal::calib {

/// Covariance of a fit when, beside the noise of readings, those of one kind (fields within twenty degrees of each
/// other) are off together, which no number of readings averages away. By how much, relative to the field, is
/// found from the kinds' mean residuals beyond their noise (method of moments: DerSimonian and Laird, Controlled
/// Clinical Trials 7, 1986); at least `least_misfit`.
[[nodiscard]] EllipsoidShape::Matrix stated_covariance(const EllipsoidFit& fit, const EllipsoidCells& cells,
                                                       const EllipsoidNoise& noise, double least_misfit);

}  // namespace navcal::calib
