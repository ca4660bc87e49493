// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "gap/nulls/bank_cache.h"
#include "tests/gap/nulls/made_up_bank.h"

namespace navcal::gap {
namespace {

class BankFile : public testing::Test {
 protected:
  [[nodiscard]] std::optional<KeptBank> through_text(const NullBank& bank) const {
    return read_bank(bank_text({{1, 2.5, -3}, bank}, "model"), "model", unknowns_);
  }
  Library library_{{}};
  Eigen::Index unknowns_ = static_cast<Eigen::Index>(library_.unknowns().size());
  NullBank bank_ = test::made_up_bank(unknowns_);
};

TEST_F(BankFile, GivesBackEveryNumber) {
  const auto kept = through_text(bank_);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->fingerprint, (std::vector<double>{1, 2.5, -3}));
  EXPECT_EQ(kept->bank.scores, bank_.scores);
  EXPECT_EQ(kept->bank.whitening.fix_factor, bank_.whitening.fix_factor);
  EXPECT_EQ(kept->bank.explained_rms.variance, bank_.explained_rms.variance);
}

TEST_F(BankFile, AnotherModelOrLibraryIsRefused) {
  const std::string text = bank_text({{1}, bank_}, "model");
  EXPECT_TRUE(read_bank(text, "model", unknowns_));
  EXPECT_FALSE(read_bank(text, "another", unknowns_));
  EXPECT_FALSE(read_bank(text, "model", unknowns_ + 1));
}

TEST_F(BankFile, ShapesThatDoNotFitOneAnotherAreRefused) {
  const auto refused = [&](auto damage) {
    NullBank bank = bank_;
    damage(bank);
    return !through_text(bank);
  };
  EXPECT_TRUE(refused([](NullBank& b) { b.missions = 19; }));
  EXPECT_TRUE(refused([](NullBank& b) { b.powers.pop_back(); }));
  EXPECT_TRUE(refused([](NullBank& b) { b.scores.conservativeResize(b.scores.rows() - 1, 20); }));
  EXPECT_TRUE(refused([](NullBank& b) { b.explained_rms.variance.resize(2, 3); }));
  EXPECT_TRUE(refused([](NullBank& b) { b.left.mean_square.resize(2, 3); }));
  EXPECT_TRUE(refused([](NullBank& b) {
    b.whitening.grid_filter = PredictionErrorFilter(Eigen::MatrixXd::Zero(11, kEvidenceChannels));
  }));
  EXPECT_TRUE(refused([](NullBank& b) { b.whitening.grid_factor(3, 3) = 0; }));
  EXPECT_TRUE(refused([](NullBank& b) { b.gram(1, 2) = std::numeric_limits<double>::quiet_NaN(); }));
}

}  // namespace
}  // namespace navcal::gap
