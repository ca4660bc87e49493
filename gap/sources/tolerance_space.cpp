// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/tolerance_space.h"

#include <Eigen/Eigenvalues>

namespace navcal::gap {

ToleranceSpace::ToleranceSpace(const Linearised& nominal, const Priors& priors)
    : residual_(residual_at_zero(nominal)) {
  const Eigen::MatrixXd inner = priors.spike.asDiagonal() * nominal.gram * priors.spike.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(inner);
  // Directions in which the tolerances show less than a twentieth of the noise explain nothing.
  constexpr double kLeast = 1.0 / 400;
  Eigen::Index first = 0;
  while (first < inner.rows() && eigen.eigenvalues()[first] < kLeast) ++first;
  const Eigen::VectorXd power = eigen.eigenvalues().tail(inner.rows() - first);
  const Eigen::MatrixXd directions = priors.spike.asDiagonal() * eigen.eigenvectors().rightCols(power.size()) *
                                     power.cwiseSqrt().cwiseInverse().asDiagonal();
  basis_ = nominal.design * directions;
  share_ = power.array() / (1 + power.array());
  scaled_score_ = share_.cwiseProduct(basis_.transpose() * residual_);
}

MarginalTraces ToleranceSpace::marginalised(const Eigen::MatrixXd& traces) const {
  const Eigen::MatrixXd shared = basis_.transpose() * traces;
  return {traces.transpose() * traces - shared.transpose() * share_.asDiagonal() * shared,
          traces.transpose() * residual_ - shared.transpose() * scaled_score_};
}

}  // namespace navcal::gap
