// SPDX-License-Identifier: Apache-2.0
#include "control/order_rate.h"

#include <gtest/gtest.h>

namespace navcal::control {
namespace {

TEST(OrderRate, AFloodPassesAtTheRate) {
  OrderRate rate(40);
  int taken = 0;
  // Ten seconds of five thousand orders a second.
  for (std::int64_t t_ns = 0; t_ns < 10'000'000'000; t_ns += 200'000) taken += rate.take(t_ns) ? 1 : 0;
  EXPECT_NEAR(taken, 400 + 10, 1) << "the rate, and one burst";
}

TEST(OrderRate, OrdersWithinTheRateAllPass) {
  OrderRate rate(40);
  for (std::int64_t t_ns = 0; t_ns < 20'000'000'000; t_ns += 25'000'001) ASSERT_TRUE(rate.take(t_ns));
}

TEST(OrderRate, TimeThatGoesBackGivesNothing) {
  OrderRate rate(1);
  EXPECT_TRUE(rate.take(5'000'000'000));
  EXPECT_TRUE(rate.take(1'000'000'000));
  EXPECT_FALSE(rate.take(5'000'000'000));
  rate.refill();
  EXPECT_TRUE(rate.take(5'000'000'000));
}

}  // namespace
}  // namespace navcal::control
