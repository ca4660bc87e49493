// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/nominal_balances.h"

#include <algorithm>
#include <limits>

namespace navcal::diagnosis {

double effective_number(const Eigen::MatrixXd& values, double least_alike) {
  constexpr double kMostAlike = 0.8;  // few neighbours tell it only roughly
  const Eigen::MatrixXd apart = values.colwise() - values.rowwise().mean();
  const Eigen::Index pairs = apart.cols() - 1;
  const double alike = apart.leftCols(pairs).cwiseProduct(apart.rightCols(pairs)).sum() /
                       std::max(apart.squaredNorm(), std::numeric_limits<double>::min());
  const double correlation = std::clamp(alike, least_alike, kMostAlike);
  return static_cast<double>(apart.cols()) * (1 - correlation) / (1 + correlation);
}

NominalBalances nominal_balances(const Eigen::MatrixXd& balances, const Eigen::MatrixXd& errors,
                                 const Eigen::MatrixXd& usual) {
  NominalBalances nominal{balances.rowwise().mean(), errors + usual, errors.diagonal()};
  if (balances.cols() < 2) return nominal;
  const Eigen::MatrixXd apart = balances.colwise() - nominal.mean;
  const Eigen::VectorXd sizes = nominal.scatter.diagonal().cwiseSqrt();
  nominal.effective = std::max(effective_number(sizes.cwiseInverse().asDiagonal() * apart, 0), 2.0);
  const double freedom = nominal.effective - 1;
  const Eigen::MatrixXd seen = apart * apart.transpose() / static_cast<double>(apart.cols() - 1);
  const Eigen::MatrixXd axes = seen.diagonal().asDiagonal();
  const Eigen::MatrixXd shrunk = (freedom * seen + kAxesWeight * axes) / (freedom + kAxesWeight);
  nominal.scatter = (freedom * shrunk + kToleranceWeight * nominal.scatter) / (freedom + kToleranceWeight);
  return nominal;
}

}  // namespace navcal::diagnosis
