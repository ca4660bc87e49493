// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "sim/layout/mass_matrix.h"

namespace navcal::sim {
namespace {

/// Lamb's integrals for semi-axes a, b, b, by which the factors are defined: a b^2 times the integral over lambda
/// > 0 of 1/((a^2 + lambda)^m (b^2 + lambda)^n).
double lamb_integral(double a, double b, double m, double n) {
  constexpr int kParts = 200'000;
  double sum = 0;
  for (int i = 0; i < kParts; ++i) {
    const double s = (i + 0.5) / kParts;  // lambda = s/(1 - s)
    const double lambda = s / (1 - s);
    sum += 1 / (std::pow(a * a + lambda, m) * std::pow(b * b + lambda, n) * (1 - s) * (1 - s));
  }
  return a * b * b * sum / kParts;
}

TEST(LambFactors, AreThoseOfHisIntegrals) {
  for (const double a : {1.5, 2.0, 10.2}) {
    const double alpha = lamb_integral(a, 1, 1.5, 1), beta = lamb_integral(a, 1, 0.5, 2);
    const double less = a * a - 1, more = a * a + 1;
    const LambFactors factors = lamb_factors(a, 1);
    EXPECT_NEAR(factors.axial, alpha / (2 - alpha), 1e-5) << a;
    EXPECT_NEAR(factors.transverse, beta / (2 - beta), 1e-5) << a;
    EXPECT_NEAR(factors.rotational, less * less * (beta - alpha) / (more * (2 * less + more * (alpha - beta))),
                1e-5)
        << a;
  }
}

TEST(LambFactors, ASphereCarriesHalfItsWaterAndANeedleAllOfItAcross) {
  const LambFactors sphere = lamb_factors(1.01, 1);
  EXPECT_NEAR(sphere.axial, 0.5, 1e-2);
  EXPECT_NEAR(sphere.transverse, 0.5, 1e-2);
  EXPECT_NEAR(sphere.rotational, 0, 1e-3);
  const LambFactors needle = lamb_factors(1000, 1);
  EXPECT_NEAR(needle.axial, 0, 1e-4);
  EXPECT_NEAR(needle.transverse, 1, 1e-4);
}

}  // namespace
}  // namespace navcal::sim
