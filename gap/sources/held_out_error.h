// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "gap/sources/source_evidence.h"

namespace navcal::gap {

/// How a description of an error predicts data that it was not fitted to.
struct HeldOutError {
  double gain_nats = 0;          ///< log likelihood with the error less that without
  double before = 0, after = 0;  ///< sums of squares of the whitened residuals, without and with it
  double measurements = 0;
};

/// Predicts another recording of the same vehicle by each of some descriptions. `problem`: that of the fits. `at`:
/// biases of the other recording about the nominal vehicle. The turn-on bias of a gyro is another one in each
/// recording, so that the error of a gyro has mean zero in both.
[[nodiscard]] std::vector<HeldOutError> predict_other(std::span<const SourceFit> fits,
                                                      const SourceProblem& problem, const ResidualModel& other,
                                                      const Eigen::VectorXd& at, const Trajectory10Hz& course);

/// Predicts the even minutes of the recording by coefficients that are fitted to the odd ones, and the other way
/// round. Weaker than another recording, because the terms were chosen on the whole of this one.
[[nodiscard]] HeldOutError predict_blocks(const SourceFit& fit, const SourceProblem& problem);

}  // namespace navcal::gap
