// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/state_history.h"

#include <gtest/gtest.h>

namespace navcal::gap {
namespace {

/// Going down by a metre a second, and found ten centimetres too high at each reading.
class Descent : public testing::Test {
 protected:
  void sail(int readings, double correction_m) {
    for (int i = 0; i < readings; ++i) {
      sim::State state;
      state.position_m = {0, 0, depth_m_};
      states_.predict(time_s_, state);
      depth_m_ += correction_m;
      states_.correct({}, {0, 0, depth_m_}, {});
      time_s_ += 0.05;
      depth_m_ += 0.05;
    }
  }
  StateHistory states_;
  double time_s_ = 0, depth_m_ = 0;
};

TEST_F(Descent, BetweenReadingsIsBetweenTheStates) {
  sail(5, 0);
  EXPECT_DOUBLE_EQ(states_.newest_s(), 0.2);
  EXPECT_NEAR(states_.filtered_at(0.075).position_m[2], 0.075, 1e-12);
  EXPECT_NEAR(states_.corrected_at(0.075).position_m[2], 0.075, 1e-12);
}

TEST_F(Descent, WhatWasKnownThenHasTheCorrectionsUntilThen) {
  sail(5, 0.1);
  EXPECT_NEAR(states_.filtered_at(0.05).position_m[2], 0.05 + 2 * 0.1, 1e-12);
}

TEST_F(Descent, WhatIsKnownNowWentTheVehiclesOwnWayAtEveryDelay) {
  sail(5, 0.1);
  // The newest reading is what is held against it: that corrects nothing yet.
  const double predicted_m = states_.predicted().position_m[2];
  for (const double delay_s : {0.001, 0.049, 0.05, 0.051, 0.12, 0.199}) {
    EXPECT_NEAR(states_.corrected_at(0.2 - delay_s).position_m[2], predicted_m - delay_s, 1e-12) << delay_s;
  }
}

TEST_F(Descent, BeforeTheFirstAndAfterTheLastAreThese) {
  sail(3, 0.1);
  EXPECT_DOUBLE_EQ(states_.filtered_at(-1).position_m[2], 0);
  EXPECT_DOUBLE_EQ(states_.corrected_at(-1).position_m[2], 0);
  EXPECT_NEAR(states_.filtered_at(9).position_m[2], 0.1 + 3 * 0.1, 1e-12);
}

TEST_F(Descent, TwelveSecondsAreRemembered) {
  sail(400, 0);
  EXPECT_NEAR(states_.filtered_at(states_.newest_s() - 11).position_m[2], states_.newest_s() - 11, 1e-9);
  EXPECT_GT(states_.filtered_at(0).position_m[2], 7);
}

}  // namespace
}  // namespace navcal::gap
