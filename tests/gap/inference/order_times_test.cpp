// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/order_times.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

TEST(OrderTimes, AreFoundByWhatTheVehicleDoes) {
  Mission mission = test::simulated_mission("calibration_swing", "", 200, 3);
  const std::vector<double> recorded = std::exchange(mission.order_times_s, {});
  ASSERT_GT(recorded.size(), 500U);
  const auto found = likely_order_times_s(mission, {}, Library({}), 2);
  ASSERT_GT(found.size(), 1990U);
  EXPECT_NEAR(std::remainder(found.front() - recorded.front(), 0.1), 0, 0.008);
}

// A fin that stands askew moved the instants by 30 ms, and something innocent was named.
TEST(OrderTimes, DoNotMakeUpForAGap) {
  Mission mission = test::simulated_mission("identification",
                                            "[fin_offset]\nangle_deg = -1\n[tilt_slosh]\ngain = 0.3\n", 200, 6);
  const std::vector<double> recorded = std::exchange(mission.order_times_s, {});
  const auto found = likely_order_times_s(mission, {}, Library({}), 2);
  EXPECT_NEAR(std::remainder(found.front() - recorded.front(), 0.1), 0, 0.008);
}

}  // namespace
}  // namespace navcal::gap
