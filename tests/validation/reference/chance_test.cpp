// SPDX-License-Identifier: Apache-2.0
// Randomness and the low-pass: what everything stochastic and everything sluggish rests on.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/reference/compass.h"
#include "validation/reference/rng.h"

namespace navcal::reference::testing {
namespace {

TEST(Rng, TheSameSeedAndStreamGiveTheSameForEver) {
  Rng dice(1, 2);
  const std::uint64_t first = dice.bits();
  EXPECT_EQ(Rng(1, 2).bits(), first);
  EXPECT_NE(Rng(1, 3).bits(), first);
  EXPECT_NE(Rng(2, 2).bits(), first);
  EXPECT_NE(Rng(2, 1).bits(), first);  // seed and stream are no sum
}

TEST(Rng, NormalHasItsMomentsAndItsTails) {
  Rng dice(3, 0);
  constexpr int kDraws = 100000;
  double sum = 0, squares = 0, fourths = 0;
  int beyond = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = dice.normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    if (std::abs(x) > 3) ++beyond;
  }
  EXPECT_LT(std::abs(sum / kDraws), 5 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1, 5 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(fourths / kDraws, 3, 5 * std::sqrt(96.0 / kDraws));
  EXPECT_NEAR(beyond, 0.0027 * kDraws, 5 * std::sqrt(0.0027 * kDraws));
}

TEST(Rng, StreamsAndSuccessiveDrawsAreUncorrelated) {
  Rng one(4, 0), other(4, 1);
  constexpr int kDraws = 20000;
  double across = 0, along = 0, last = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = one.normal();
    across += x * other.normal();
    along += x * last;
    last = x;
  }
  EXPECT_LT(std::abs(across / kDraws), 5 / std::sqrt(kDraws));
  EXPECT_LT(std::abs(along / kDraws), 5 / std::sqrt(kDraws));
}

TEST(Rng, UniformAndExponentialKeepTheirBounds) {
  Rng dice(5, 0);
  double sum = 0;
  for (int i = 0; i < 20000; ++i) {
    const double u = dice.uniform(2, 10);
    ASSERT_GE(u, 2);
    ASSERT_LT(u, 10);
    const double e = dice.exponential(0.5);
    ASSERT_GE(e, 0);
    sum += e;
  }
  EXPECT_NEAR(sum / 20000, 0.5, 5 * 0.5 / std::sqrt(20000.0));
}

TEST(Lag, IsExactForARampHoweverItIsCut) {
  // tau y' + y = t, y(0) = 0: y = t - tau + tau exp(-t/tau)
  Lag<double> fine, coarse;
  constexpr double kTau_s = 0.3;
  fine.feed(0, kTau_s, 0);
  coarse.feed(0, kTau_s, 0);
  for (int i = 1; i <= 100; ++i) fine.feed(0.01, kTau_s, 0.01 * i);
  coarse.feed(1, kTau_s, 1);
  const double exact = 1 - kTau_s + kTau_s * std::exp(-1 / kTau_s);
  EXPECT_NEAR(fine.output(), exact, 1e-12);
  EXPECT_NEAR(coarse.output(), exact, 1e-12);
}

TEST(Lag, BeginsAtItsFirstInputAndWithoutLagPassesOn) {
  Lag<double> lag;
  EXPECT_EQ(lag.feed(0.1, 60, 5), 5);
  EXPECT_EQ(lag.feed(0.1, 0, 7), 7);
}

}  // namespace
}  // namespace navcal::reference::testing
