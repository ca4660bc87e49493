// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/nominal_balances.h"

#include <gtest/gtest.h>

#include <random>

namespace navcal::diagnosis {
namespace {

/// Independent balances of unit size; `alike`: so many in a row are the same but for a tenth of that.
Eigen::MatrixXd balances_of(Eigen::Index count, Eigen::Index alike, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd all(6, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index i = 0; i < 6; ++i)
      all(i, k) = k % alike == 0 ? normal(random) : all(i, k - k % alike) + 0.1 * normal(random);
  }
  return all;
}

TEST(NominalBalances, RecordingsThatAreLikeTheirNeighboursCountLess) {
  const Eigen::MatrixXd small = 1e-4 * Eigen::MatrixXd::Identity(6, 6);
  double independent = 0, in_threes = 0;
  constexpr int kDraws = 20;
  for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
    independent += nominal_balances(balances_of(12, 1, seed), small, small).effective / kDraws;
    in_threes += nominal_balances(balances_of(12, 3, seed), small, small).effective / kDraws;
  }
  EXPECT_NEAR(independent, 12, 2);
  EXPECT_NEAR(in_threes, 4, 1.5);
}

TEST(NominalBalances, OneRecordingHasTheUsualScatterAndManyHaveTheirOwn) {
  const Eigen::MatrixXd errors = 0.01 * Eigen::MatrixXd::Identity(6, 6), usual = 4 * errors;
  const NominalBalances one = nominal_balances(balances_of(1, 1, 5), errors, usual);
  EXPECT_TRUE(one.scatter.isApprox(errors + usual));
  EXPECT_DOUBLE_EQ(one.effective, 1);
  const NominalBalances many = nominal_balances(balances_of(400, 1, 5), errors, usual);
  EXPECT_TRUE(many.scatter.isApprox(Eigen::MatrixXd::Identity(6, 6), 0.2)) << many.scatter;
  EXPECT_LT(many.mean.norm(), 0.3);
}

}  // namespace
}  // namespace navcal::diagnosis
