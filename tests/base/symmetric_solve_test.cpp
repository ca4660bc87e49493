// SPDX-License-Identifier: Apache-2.0
#include "base/symmetric_solve.h"

#include <gtest/gtest.h>

namespace navcal::base {
namespace {

TEST(SymmetricSolve, SolvesForEachColumn) {
  for (int size = 1; size < 8; ++size) {
    const Eigen::MatrixXd random = Eigen::MatrixXd::Random(size, size);
    const Eigen::MatrixXd a = random * random.transpose() - 0.3 * Eigen::MatrixXd::Identity(size, size);
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(size, 3);
    EXPECT_LT((a * solve_symmetric(a, b) - b).cwiseAbs().maxCoeff(), 1e-8) << size;
    EXPECT_LT((a * inverse_symmetric(a) - Eigen::MatrixXd::Identity(size, size)).cwiseAbs().maxCoeff(), 1e-8)
        << size;
  }
}

TEST(SymmetricSolve, TakesMatricesOfFixedSize) {
  const Eigen::Matrix3d a = Eigen::Vector3d(1, 2, 4).asDiagonal();
  const Eigen::Vector3d x = solve_symmetric(a, Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(x, Eigen::Vector3d(1, 0.5, 0.25));
}

}  // namespace
}  // namespace navcal::base
