#include "gap/order_times.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

// The simulator's autopilot gives its orders at the whole tenths of a second of its clock, which are not those of
// the recording.
TEST(OrderTimes, AreFoundByWhatTheVehicleDoes) {
  const Mission mission = test::simulated_mission("calibration_swing", "", 200, 3);
  ASSERT_TRUE(mission.order_times_s.empty());
  const auto found = likely_order_times_s(mission, {}, Library({}), 2);
  ASSERT_GT(found.size(), 1900U);
  // Reports are taken at the whole tenths, too.
  const double after_s = found.front() - mission.motor[1000].time_s;
  EXPECT_NEAR(std::remainder(after_s, 0.1), 0, 0.016);
}

}  // namespace
}  // namespace navcal::gap
