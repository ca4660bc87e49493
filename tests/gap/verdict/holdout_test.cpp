// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/holdout.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/gap/prepared_mission.h"

namespace navcal::gap {
namespace {

/// A mission of a vehicle whose motor makes a field of 1 uT/A along x.
class HeldOutMission : public testing::Test {
 protected:
  [[nodiscard]] Eigen::VectorXd field_of(double x_uT_per_A) const {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library_.unknowns().size()));
    values[library_.first(test::index_of(library_, "motor_field"))] = x_uT_per_A;
    return values;
  }

  const Library library_{{}};
  const std::unique_ptr<Prepared> mission_ =
      test::prepared_mission({.effects = "[motor_field]\nx_uT_per_A = 1\n", .seconds = 80}, library_, {8, 1, 2});
};

TEST_F(HeldOutMission, WithoutEffectsBeforeAndAfterAreTheSame) {
  const Comparison same = compare(*mission_, library_, field_of(0));
  EXPECT_EQ(same.before.mean_square, same.after.mean_square);
  EXPECT_EQ(same.before.blocks, same.after.blocks);
  EXPECT_GT(same.measurements, 0);
}

TEST_F(HeldOutMission, BlocksAddUpToTheWhole) {
  const Comparison compared = compare(*mission_, library_, field_of(1));
  for (const Power& power : {compared.before, compared.after}) {
    const double sum = std::accumulate(power.blocks.begin(), power.blocks.end(), 0.0);
    EXPECT_NEAR(sum, power.mean_square * compared.measurements, 1e-6 * sum);
  }
  EXPECT_GE(compared.before.blocks.size(), 8U) << "ten seconds each";
}

TEST_F(HeldOutMission, TheTrueEffectsLeaveTheFloor) {
  const Comparison compared = compare(*mission_, library_, field_of(1));
  EXPECT_GT(compared.before.mean_square, 2 * compared.floor);
  EXPECT_NEAR(compared.after.mean_square, compared.floor, 0.3 * compared.floor);
  EXPECT_GT(compared.floor_std, 0);
  const PooledClosure closure = pooled_closure({compared});
  ASSERT_TRUE(closure.clear);
  EXPECT_GT(closure.closed, 0.9);
}

TEST_F(HeldOutMission, TheBiasesOfTheEffectsAreNotUsed) {
  Eigen::VectorXd with_biases = field_of(1);
  with_biases.head<Library::kBiases>().setConstant(0.3);
  EXPECT_EQ(compare(*mission_, library_, with_biases).after.mean_square,
            compare(*mission_, library_, field_of(1)).after.mean_square);
}

TEST_F(HeldOutMission, TheLikelihoodGrowsWithTheTrueEffectAndFallsWithItsOpposite) {
  const ResidualModel model = mission_->model(library_, 1);
  EXPECT_EQ(predict_held_out(model, field_of(0), field_of(0)).gain_nats, 0);
  const HeldOutPrediction truly = predict_held_out(model, field_of(0), field_of(1));
  EXPECT_GT(truly.gain_nats, 100);
  EXPECT_LT(predict_held_out(model, field_of(0), field_of(-1)).gain_nats, -100);
  EXPECT_NEAR(predict_held_out(model, field_of(1), field_of(0)).gain_nats, -truly.gain_nats,
              1e-6 * truly.gain_nats);
  // compare() begins at other biases; both are fitted anew.
  EXPECT_NEAR(truly.power.mean_square, compare(*mission_, library_, field_of(1)).after.mean_square, 0.001);
}

}  // namespace
}  // namespace navcal::gap
