// SPDX-License-Identifier: Apache-2.0
#include "base/vectors.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace navcal::base {
namespace {

TEST(Vectors, TheMatrixOfAVectorGivesTheCrossProduct) {
  const Eigen::Vector3d v(1, -2, 3), w(0.5, 4, -7);
  EXPECT_EQ(cross_product_matrix(v) * w, v.cross(w));
  EXPECT_EQ(cross_product_matrix(v), -cross_product_matrix(v).transpose());
}

TEST(Vectors, KeepTheirOrder) { EXPECT_EQ(vector_of({1, 2, 3}), Eigen::Vector3d(1, 2, 3)); }

}  // namespace
}  // namespace navcal::base
