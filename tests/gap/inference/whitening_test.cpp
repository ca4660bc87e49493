// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/whitening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace navcal::gap {
namespace {

constexpr Eigen::Index kNoiseRows = 3000;

/// Coloured and correlated between channels.
Innovations coloured(std::uint64_t seed) {
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  Innovations made;
  made.grid = Eigen::MatrixXd::Zero(kNoiseRows, kChannels);
  made.fixes = Eigen::MatrixXd::NullaryExpr(50, kFixChannels, [&] { return 2 * normal(dice); });
  for (Eigen::Index i = 0; i < kNoiseRows; ++i) {
    const double common = normal(dice);
    for (Eigen::Index j = 0; j < kChannels; ++j) {
      const double before = i > 0 ? made.grid(i - 1, j) : 0;
      made.grid(i, j) = 0.7 * before + 0.1 * static_cast<double>(j + 1) * (normal(dice) + 0.5 * common);
    }
  }
  return made;
}

Layout layout() {
  Layout made;
  made.intervals = kNoiseRows;
  for (int i = 0; i < 50; ++i) made.fix_numbers.push_back(i % 25);
  return made;
}

Whitening learnt_whitening() {
  const std::vector<Innovations> noise{coloured(1), coloured(2), coloured(3)};
  const std::vector<Layout> layouts(3, layout());
  return Whitening(noise, layouts);
}

TEST(Whitening, WhatItWasLearntFromBecomesWhiteAndOfSizeOne) {
  const Eigen::VectorXd white = learnt_whitening()(coloured(4), layout());
  EXPECT_NEAR(white.squaredNorm() / static_cast<double>(Whitening::count(white)), 1, 0.03);
  double next = 0, beside = 0;
  for (Eigen::Index i = 300 * kEvidenceChannels; i + kEvidenceChannels < kNoiseRows * kEvidenceChannels; ++i) {
    next += white[i] * white[i + kEvidenceChannels];
    beside += i % kEvidenceChannels != kEvidenceChannels - 1 ? white[i] * white[i + 1] : 0;
  }
  EXPECT_LT(std::abs(next) / static_cast<double>(white.size()), 0.03);
  EXPECT_LT(std::abs(beside) / static_cast<double>(white.size()), 0.03);
}

TEST(Whitening, IsLinear) {
  const Whitening whitening = learnt_whitening();
  const Innovations a = coloured(5), b = coloured(6);
  Innovations sum = a;
  sum.grid += 2 * b.grid;
  sum.fixes += 2 * b.fixes;
  const Eigen::VectorXd apart = whitening(a, layout()) + 2 * whitening(b, layout());
  EXPECT_LT((whitening(sum, layout()) - apart).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Whitening, WhatWasNotMeasuredIsNothing) {
  Innovations made = coloured(7);
  made.grid.block(1000, 2, 50, 1).setConstant(std::numeric_limits<double>::quiet_NaN());
  made.grid.col(5).setConstant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::VectorXd white = learnt_whitening()(made, layout());
  EXPECT_TRUE(white.allFinite());
  for (Eigen::Index i = 0; i < kNoiseRows; ++i) {
    EXPECT_EQ(white[i * kEvidenceChannels + 5], 0);
    if (i >= 1000 && i < 1050) {
      EXPECT_EQ(white[i * kEvidenceChannels + 2], 0);
    }
  }
}

}  // namespace
}  // namespace navcal::gap
