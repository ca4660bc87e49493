// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/where.h"

#include <gtest/gtest.h>

#include "gap/replay/regimes.h"

namespace navcal::gap {
namespace {

class WhereMap : public testing::Test {
 protected:
  WhereMap() {
    std::vector<Eigen::MatrixXd> of_nulls;
    for (int i = 0; i < 40; ++i) of_nulls.push_back(quiet(1 + 0.02 * (i % 5)));
    nulls_ = RegimeStatistics(of_nulls);
  }
  static Eigen::MatrixXd quiet(double size = 1) {
    return Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(reported_channels().size()),
                                     static_cast<Eigen::Index>(regimes().size()), size);
  }
  static std::string name_of(Eigen::Index channel) {
    return std::string(reported_channels()[static_cast<std::size_t>(channel)].name);
  }
  RegimeStatistics nulls_;
};

TEST_F(WhereMap, PutsFirstWhatIsFurthestBeyondTheNulls) {
  Eigen::MatrixXd explained_rms = quiet();
  explained_rms(3, 1) = 4;
  explained_rms(5, 2) = 2;
  const auto clear = significant_cells(residual_map(explained_rms, nulls_));
  ASSERT_EQ(clear.size(), 2U);
  EXPECT_EQ(clear[0].channel, name_of(3));
  EXPECT_EQ(clear[1].channel, name_of(5));
}

// A wrong tilt turns the depth that is reckoned with it, whose slow part nulls scatter least in: more plainly seen
// there, but a small part of the depth's noise.
TEST_F(WhereMap, PutsALargeExcessBeforeAPlainOne) {
  std::vector<Eigen::MatrixXd> of_nulls;
  for (int i = 0; i < 40; ++i) {
    of_nulls.push_back(quiet(1 + 0.02 * (i % 5)));
    of_nulls.back()(5, 2) /= 50;
  }
  Eigen::MatrixXd explained_rms = quiet();
  explained_rms(3, 1) = 2;
  explained_rms(5, 2) = 0.5;
  const auto clear = significant_cells(residual_map(explained_rms, RegimeStatistics(of_nulls)));
  ASSERT_EQ(clear.size(), 2U);
  EXPECT_EQ(clear[0].channel, name_of(3));
  EXPECT_LT(clear[1].p_value, clear[0].p_value);
}

TEST_F(WhereMap, AnInstrumentALittleNoisierIsNotClearOfNullsHoweverSureThatIs) {
  Eigen::MatrixXd explained_rms = quiet();
  explained_rms(3, 1) = 1.34;
  const auto map = residual_map(explained_rms, nulls_);
  EXPECT_LT(map.front().p_value, 1e-4);
  EXPECT_TRUE(significant_cells(map).empty());
}

// Vehicles known to the last number leave a tenth of what tolerances make: a saturated magnetometer that iron
// nearly explains leaves half a tolerance more than that, and speaks for itself.
TEST_F(WhereMap, WhatIsLeftIsHeldAgainstKnownVehiclesButMustBeMoreThanTolerance) {
  std::vector<Eigen::MatrixXd> of_known;
  for (int i = 0; i < 30; ++i) of_known.push_back(quiet(0.1 + 0.01 * (i % 7)));
  const RegimeStatistics known(of_known);
  Eigen::MatrixXd left = quiet(0.1);
  left(3, 1) = 1.2;  // beyond any known vehicle, but no more than a tolerance
  left(5, 2) = 1.5;
  ASSERT_TRUE(significant_cells(residual_map(quiet(0.1), known)).empty());
  const auto beyond = significant_against_exact_model(left, known, nulls_);
  ASSERT_EQ(beyond.size(), 1U);
  EXPECT_EQ(beyond[0].channel, name_of(5));
  EXPECT_EQ(beyond[0].regime, regimes()[2]);
}

TEST_F(WhereMap, MostChangedIsWhereTheEffectsTakeMostAway) {
  Eigen::MatrixXd before = quiet(), after = quiet();
  before(3, 1) = after(3, 1) = 1.35;  // the loudest, which the effects leave as it is
  before(7, 4) = 1.2;
  const WhereEntry entry = most_changed(residual_map(before, nulls_), before, after, nulls_);
  EXPECT_EQ(entry.channel, name_of(7));
  EXPECT_EQ(entry.regime, regimes()[4]);
}

}  // namespace
}  // namespace navcal::gap
