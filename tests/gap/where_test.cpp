#include "gap/where.h"

#include <gtest/gtest.h>

#include "gap/regimes.h"

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
  Eigen::MatrixXd followed = quiet();
  followed(3, 1) = 4;
  followed(5, 2) = 2;
  const auto clear = clear_of_nulls(where_map(followed, nulls_));
  ASSERT_EQ(clear.size(), 2U);
  EXPECT_EQ(clear[0].channel, name_of(3));
  EXPECT_EQ(clear[1].channel, name_of(5));
}

TEST_F(WhereMap, AnInstrumentALittleNoisierIsNotClearOfNullsHoweverSureThatIs) {
  Eigen::MatrixXd followed = quiet();
  followed(3, 1) = 1.34;
  const auto map = where_map(followed, nulls_);
  EXPECT_LT(map.front().p_value, 1e-4);
  EXPECT_TRUE(clear_of_nulls(map).empty());
}

TEST_F(WhereMap, MostChangedIsWhereTheEffectsTakeMostAway) {
  Eigen::MatrixXd before = quiet(), after = quiet();
  before(3, 1) = after(3, 1) = 1.35;  // the loudest, which the effects leave as it is
  before(7, 4) = 1.2;
  const WhereEntry entry = most_changed(where_map(before, nulls_), before, after, nulls_);
  EXPECT_EQ(entry.channel, name_of(7));
  EXPECT_EQ(entry.regime, regimes()[4]);
}

}  // namespace
}  // namespace navcal::gap
