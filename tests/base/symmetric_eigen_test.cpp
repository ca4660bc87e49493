// SPDX-License-Identifier: Apache-2.0
#include "base/symmetric_eigen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace navcal::base {
namespace {

Eigen::MatrixXd random_symmetric(Eigen::Index size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(random); });
  return any + any.transpose();
}

TEST(SymmetricEigen, ValuesAndVectorsGiveTheMatrixBack) {
  std::mt19937 random(1);
  for (Eigen::Index size = 1; size <= 12; ++size) {
    const Eigen::MatrixXd matrix = random_symmetric(size, random);
    const SymmetricEigen found = symmetric_eigen(matrix);
    SCOPED_TRACE(size);
    EXPECT_LT((found.vectors * found.values.asDiagonal() * found.vectors.transpose() - matrix).norm(), 1e-11);
    EXPECT_LT((found.vectors.transpose() * found.vectors - Eigen::MatrixXd::Identity(size, size)).norm(), 1e-12);
    for (Eigen::Index i = 1; i < size; ++i) EXPECT_LE(found.values[i - 1], found.values[i]);
    EXPECT_LT((symmetric_eigenvalues(matrix) - found.values).norm(), 1e-11);
  }
}

TEST(SymmetricEigen, OfTwoMatricesSolvesTheirEquation) {
  std::mt19937 random(2);
  for (Eigen::Index size = 1; size <= 8; ++size) {
    const Eigen::MatrixXd a = random_symmetric(size, random), root = random_symmetric(size, random);
    const Eigen::MatrixXd b = root * root.transpose() + Eigen::MatrixXd::Identity(size, size);
    const SymmetricEigen found = generalized_symmetric_eigen(a, b);
    SCOPED_TRACE(size);
    EXPECT_LT((a * found.vectors - b * found.vectors * found.values.asDiagonal()).norm(), 1e-11 * b.norm());
    EXPECT_LT((found.vectors.transpose() * b * found.vectors - Eigen::MatrixXd::Identity(size, size)).norm(),
              1e-10);
  }
}

TEST(SymmetricEigen, TakesFixedSizesAndSingularMatrices) {
  Eigen::Matrix2d singular;
  singular << 1, 1, 1, 1;
  const Eigen::Vector2d values = symmetric_eigenvalues(singular);
  EXPECT_NEAR(values[0], 0, 1e-15);
  EXPECT_NEAR(values[1], 2, 1e-15);
}

TEST(SymmetricEigen, WhatIsNotFiniteGivesNothingThatIs) {
  Eigen::Matrix3d broken = Eigen::Matrix3d::Identity();
  broken(1, 0) = broken(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(symmetric_eigenvalues(broken).allFinite());
}

}  // namespace
}  // namespace navcal::base
