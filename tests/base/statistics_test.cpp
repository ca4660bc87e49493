// SPDX-License-Identifier: Apache-2.0
#include "base/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace navcal::base::test {
namespace {

TEST(LogSumExp, HoldsFarBelowZero) {
  EXPECT_NEAR(log_sum_exp(std::vector<double>{-2000, -2000}), -2000 + std::log(2.0), 1e-12);
  EXPECT_NEAR(log_sum_exp(std::vector<double>{-5000, 1}), 1, 1e-12);
  EXPECT_NEAR(log_sum_exp(-2000, -2000), -2000 + std::log(2.0), 1e-12);
  EXPECT_EQ(log_sum_exp(-INFINITY, -INFINITY), -INFINITY);
  EXPECT_EQ(log_sum_exp(-INFINITY, 3), 3);
  EXPECT_NEAR(log_mean_exp(std::vector<double>{-2000, -2000}), -2000, 1e-12);
}

}  // namespace
}  // namespace navcal::base::test
