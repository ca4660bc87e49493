// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "base/symmetric_eigen.h"
#include "base/symmetric_solve.h"
#include "calib/turn/turn_filter.h"

namespace navcal::calib {

double TurnFilter::condition() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto sought = [this](int i) { return prior_.sought[static_cast<std::size_t>(i)]; };
  TurnCovariance information = unscaled_covariance();
  // The others become ones on the diagonal: among eigenvalues whose mean is one they are never the extremes.
  for (int i = 0; i < 6; ++i) {
    if (sought(i)) continue;
    information.row(i).setZero();
    information.col(i).setZero();
    information(i, i) = 1;
  }
  information = base::inverse_symmetric(information);
  for (int i = 0; i < 6; ++i) {
    if (!sought(i)) continue;
    const double believed = 1 / prior_.covariance(i, i);
    information(i, i) -= believed;
    // Hardly more than was believed before, which is next to nothing.
    if (!(information(i, i) > believed)) return kInfinity;
  }
  const Eigen::Matrix<double, 6, 1> unit = information.diagonal().cwiseSqrt().cwiseInverse();
  information = (unit.asDiagonal() * information * unit.asDiagonal()).eval();
  const Eigen::Matrix<double, 6, 1> eigenvalues = base::symmetric_eigenvalues(information);
  if (!(eigenvalues[0] > 0)) return kInfinity;
  return eigenvalues[5] / eigenvalues[0];
}

}  // namespace navcal::calib
