// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "gap/inference/linearised.h"
#include "gap/inference/spike_and_slab.h"

namespace navcal::gap {

/// Gram matrix Z^T (1 + X D^2 X^T)^-1 Z and score Z^T (1 + X D^2 X^T)^-1 r of some traces Z.
struct MarginalTraces {
  Eigen::MatrixXd gram;
  Eigen::VectorXd score;
};

/// What the tolerances of a vehicle can explain in the residuals r of one recording: X are the derivatives by the
/// tolerances, D their standard deviations.
class ToleranceSpace {
 public:
  ToleranceSpace(const Linearised& nominal, const Priors& priors);

  /// `traces`: a column each, in the rows of the residuals. What tolerances can explain counts less in them.
  [[nodiscard]] MarginalTraces marginalised(const Eigen::MatrixXd& traces) const;

 private:
  Eigen::VectorXd residual_, share_, scaled_score_;
  Eigen::MatrixXd basis_;  ///< orthonormal
};

}  // namespace navcal::gap
