// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calib/magnetometer/ellipsoid_fit.h"

namespace navcal::calib {

/// Error of a fit when, beside the noise of readings, those of one kind (fields within twenty degrees of each
/// other) are off together, which no number of readings averages away. By how much, relative to the field, is
/// found from the kinds' mean residuals beyond their noise (method of moments: DerSimonian and Laird, Controlled
/// Clinical Trials 7, 1986); at least `least_misfit`.
///
/// Beside them an offset of the inclinometer from the compass's axes, as far as the readings do not tell it: level
/// turns do not tell it from soft iron with hard iron. Its prior is as large as such soft iron is, within 0.2 and
/// 1 degree: an inclinometer that is further off would have to be hidden by iron of the same effect.
[[nodiscard]] EllipsoidError stated_error(const EllipsoidFit& fit, const EllipsoidCells& cells,
                                          const EllipsoidNoise& noise, double least_misfit);

}  // namespace navcal::calib
