// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "gap/verdict/sources.h"

namespace navcal::gap {
namespace {

Eigen::VectorXd quiet(const Layout& layout) {
  const auto fixes = static_cast<Eigen::Index>(layout.fix_numbers.size());
  return Eigen::VectorXd::Constant(layout.intervals * kEvidenceChannels + fixes * kFixChannels, 0.1);
}

TEST(LoudestPiece, ContainsTheLoudIntervals) {
  const Layout layout{3000, {}};
  Eigen::VectorXd residual = quiet(layout);
  residual.segment(2000 * kEvidenceChannels, 100 * kEvidenceChannels).setConstant(3);
  const double from_s = loudest_piece_s(residual, layout, {}, 100);
  EXPECT_LE(from_s, 200);
  EXPECT_GE(from_s + 100, 210);
}

TEST(LoudestPiece, ContainsTheLoudFix) {
  const Layout layout{3000, {0, 1}};
  Eigen::VectorXd residual = quiet(layout);
  residual.tail(kFixChannels).setConstant(20);
  const double from_s = loudest_piece_s(residual, layout, {20.0, 250.0}, 100);
  EXPECT_LE(from_s, 250);
  EXPECT_GE(from_s + 100, 250);
}

TEST(LoudestPiece, OfAShortMissionBeginsWithIt) {
  const Layout layout{300, {}};
  EXPECT_EQ(loudest_piece_s(quiet(layout), layout, {}, 100), 0);
  EXPECT_EQ(loudest_piece_s(Eigen::VectorXd(), {0, {}}, {}, 100), 0);
}

TEST(LoudestPiece, IgnoresFixesOutsideTheMission) {
  const Layout layout{300, {0, 1}};
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(quiet(layout).size());
  residual.tail(2 * kFixChannels).setConstant(20);
  EXPECT_EQ(loudest_piece_s(residual, layout, {-5.0, 1000.0}, 10), 0);
}

}  // namespace
}  // namespace navcal::gap
