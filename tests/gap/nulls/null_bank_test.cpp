// SPDX-License-Identifier: Apache-2.0
// Small banks of short missions.
#include "gap/nulls/null_bank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/gap/prepared_mission.h"

namespace navcal::gap {
namespace {

class NullBankOfAShortMission : public testing::Test {
 protected:
  [[nodiscard]] NullBank bank(const BankOptions& options, const std::function<void(double)>& progress) const {
    return make_null_bank({*mission_->replay, mission_->course, vehicle_}, library_, mission_->at, options,
                          progress);
  }
  [[nodiscard]] NullBank bank(const BankOptions& options) const {
    return bank(options, [](double) {});
  }

  const config::VehicleSettings vehicle_{};
  const Library library_{{}};
  /// Its own bank is empty.
  const std::unique_ptr<Prepared> mission_ =
      test::prepared_mission({.effects = "[motor_field]\nx_uT_per_A = 1\n", .seconds = 60}, library_, {0, 1, 1});
};

TEST_F(NullBankOfAShortMission, HasAColumnAndAPowerForEachMission) {
  constexpr int kMissions = 6;
  const NullBank made = bank({kMissions, 3, 2});
  const auto unknowns = static_cast<Eigen::Index>(library_.unknowns().size());
  ASSERT_EQ(made.missions, kMissions);
  EXPECT_EQ(made.seed, 3U);
  EXPECT_EQ(made.gram.rows(), unknowns);
  EXPECT_EQ(made.gram.cols(), unknowns);
  EXPECT_EQ(made.gram, made.gram.transpose());
  EXPECT_EQ(made.scores.rows(), unknowns);
  EXPECT_EQ(made.scores.cols(), kMissions);
  EXPECT_TRUE(made.scores.allFinite());
  ASSERT_EQ(made.powers.size(), static_cast<std::size_t>(kMissions));
  // Whitened noise has a mean square of 1; tolerances and a filter of six short missions add to it.
  for (const double power : made.powers) {
    EXPECT_GT(power, 0.8);
    EXPECT_LT(power, 3);
  }
  EXPECT_TRUE((made.explained_rms.mean_square.array() >= 0).all());
  EXPECT_EQ(made.left.mean_square.rows(), made.explained_rms.mean_square.rows());
  EXPECT_EQ(made.left.mean_square.cols(), made.explained_rms.mean_square.cols());
}

TEST_F(NullBankOfAShortMission, KnowsNothingOfTheGapOfTheRecordedMission) {
  const NullBank made = bank({6, 3, 2});
  const Eigen::VectorXd recorded = residual_at({*mission_->replay, library_, made.whitening}, mission_->at);
  const double power = recorded.squaredNorm() / static_cast<double>(Whitening::count(recorded));
  EXPECT_GT(power, 2 * *std::max_element(made.powers.begin(), made.powers.end()));
}

TEST_F(NullBankOfAShortMission, DependsOnTheSeedAndNotOnTheNumberOfThreads) {
  const NullBank one = bank({4, 3, 1}), four = bank({4, 3, 4}), other = bank({4, 4, 1});
  EXPECT_EQ(one.scores, four.scores);
  EXPECT_EQ(one.gram, four.gram);
  EXPECT_EQ(one.powers, four.powers);
  EXPECT_EQ(one.explained_rms.mean_square, four.explained_rms.mean_square);
  EXPECT_NE(one.scores, other.scores);
}

TEST_F(NullBankOfAShortMission, ReportsProgressToTheEnd) {
  std::vector<double> shares;
  (void)bank({4, 1, 2}, [&](double share) { shares.push_back(share); });
  ASSERT_EQ(shares.size(), 5U) << "one each, and the end";
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
}

TEST_F(NullBankOfAShortMission, OfNoMissionsIsEmpty) {
  const NullBank none = bank({0, 1, 2});
  EXPECT_EQ(none.missions, 0);
  EXPECT_TRUE(none.powers.empty());
  EXPECT_EQ(none.scores.size(), 0);
}

TEST(FittedInto, CutsAndFillsUpWithWhatWasNotMeasured) {
  Innovations innovations;
  innovations.grid = Eigen::MatrixXd::Ones(4, kChannels);
  innovations.fixes = Eigen::MatrixXd::Ones(2, kFixChannels);
  const Innovations shaped = fitted_into(innovations, Layout{3, {0, 1, 2}});
  EXPECT_EQ(shaped.grid, Eigen::MatrixXd::Ones(3, kChannels));
  ASSERT_EQ(shaped.fixes.rows(), 3);
  EXPECT_EQ(shaped.fixes.topRows(2), innovations.fixes);
  EXPECT_TRUE(shaped.fixes.row(2).array().isNaN().all());
}

}  // namespace
}  // namespace navcal::gap
