// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "diagnosis/limits.h"
#include "sim/vehicle/body.h"

namespace navcal::diagnosis {

/// Mean balances of the nominal recordings of a vehicle, N and Nm.
struct NominalBalances {
  sim::Vector6 mean = sim::Vector6::Zero();               ///< what the layout leaves out of every recording
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(6, 6);  ///< covariance of one recording about it
  sim::Vector6 errors = sim::Vector6::Zero();             ///< variances of the errors within one
  /// Recordings that would tell as much if none were like its neighbour.
  double effective = 1;

  /// Of the scatter.
  [[nodiscard]] double freedom() const { return effective - 1 + kToleranceWeight; }
};

/// `balances`: one column for each recording, in the order in which they were made. `errors`: mean covariance of
/// the errors within one; `usual`: scatter by usual tolerances. The scatter is the mean of what is seen, of the
/// same without correlations of the axes (counting as kAxesWeight recordings) and of errors and usual tolerances
/// (as kToleranceWeight).
[[nodiscard]] NominalBalances nominal_balances(const Eigen::MatrixXd& balances, const Eigen::MatrixXd& errors,
                                               const Eigen::MatrixXd& usual);

/// Number of independent values that tell as much of their mean as these, which follow one another:
/// n (1 - r) / (1 + r), r the correlation of neighbours. A row for each of several quantities that share it.
[[nodiscard]] double effective_number(const Eigen::MatrixXd& values, double least_alike);

}  // namespace navcal::diagnosis
