// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "analysis/calibrate_history.h"
#include "calib/correction.h"

namespace navcal::analysis {

/// A heading against the integrated gyro. The gyro knows no north, so within a block of turning the mean is taken
/// away, and what all headings have in common does not show.
struct HeadingResidual {
  double heading_rad = 0;    ///< as the compass says it
  double before_rad = 0;     ///< as the compass says it, less the gyro's
  double after_rad = 0;      ///< calibrated, less the gyro's
  double deviation_rad = 0;  ///< `before` set upon the deviation that was found: its mean over the block is that
                             ///< of the curve
};

/// Residuals by the gyro of `estimates`; empty without one, or without turns. Blocks turn by half a radian or
/// more.
[[nodiscard]] std::vector<HeadingResidual> heading_residuals(const std::vector<TurnedSample>& samples,
                                                             const calib::Correction& estimates);

[[nodiscard]] double root_mean_square(const std::vector<HeadingResidual>& residuals,
                                      double HeadingResidual::*which);

}  // namespace navcal::analysis
