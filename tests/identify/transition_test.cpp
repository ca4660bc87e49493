// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "identify/filter/filter_model.h"

namespace navcal::identify {
namespace {

constexpr double kStep_s = 0.1, kTau_s = 3;

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// The matrix element by element, as it is defined.
FilterMatrix matrix_of(const StepDerivatives& derivatives, double tilt_lag_s) {
  FilterMatrix all = FilterMatrix::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) all(i, i) = 1;
  for (Eigen::Index row = 0; row < kStates; ++row) {
    for (Eigen::Index i = 0; i < 9; ++i) all(row, 3 + i) = derivatives(row, i);
    // The disturbance acts as half a change of velocity before the step, and half behind it.
    for (Eigen::Index i = 0; i < 6; ++i)
      all(row, kStates + i) = kStep_s / 2 * (derivatives(row, 3 + i) + (row == 6 + i ? 1 : 0));
  }
  for (Eigen::Index i = 12; i < 14; ++i) all(i, i) = tilt_lag_s > 0 ? std::exp(-kStep_s / tilt_lag_s) : 0;
  for (Eigen::Index i = 14; i < 20; ++i) all(i, i) = std::exp(-kStep_s / kTau_s);
  return all;
}

TEST(Transition, IsItsMatrix) {
  std::mt19937 random(7);
  for (const double tilt_lag_s : {0.0, 0.3}) {
    const StepDerivatives derivatives = random_matrix(kStates, 9, random);
    const Transition transition(derivatives, tilt_lag_s, kStep_s, kTau_s);
    const FilterMatrix matrix = matrix_of(derivatives, tilt_lag_s);
    const FilterState state = random_matrix(kFilterStates, 1, random);
    EXPECT_LT((transition * state - matrix * state).norm(), 1e-12);
    const FilterMatrix root = random_matrix(kFilterStates, kFilterStates, random);
    const FilterMatrix covariance = root * root.transpose();
    const FilterMatrix after = transition.on_both_sides_of(covariance);
    EXPECT_LT((after - matrix * covariance * matrix.transpose()).norm(), 1e-12 * after.norm());
    EXPECT_EQ(after, after.transpose());
  }
}

}  // namespace
}  // namespace navcal::identify
