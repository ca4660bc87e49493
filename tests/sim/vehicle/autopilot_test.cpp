// SPDX-License-Identifier: Apache-2.0
#include "autopilot/autopilot.h"

#include <gtest/gtest.h>

#include "tests/sim/vehicle/runs.h"

namespace navcal::sim::testing {
namespace {

TEST(Autopilot, ALongDiveLeavesNothingBehindInItsIntegrals) {
  const auto motion = on_mission("start.depth_m = 1\nstep = [{do = \"leg\", depth_m = 30, seconds = 200}]\n");
  double deepest_m = 0;
  for (double t = 0; t < 200; t += 0.5) deepest_m = std::max(deepest_m, motion.at(at_s(t)).position_m[2]);
  EXPECT_LT(deepest_m, 30.5);
  EXPECT_NEAR(motion.at(at_s(199)).position_m[2], 30, 0.1);
}

TEST(Autopilot, HoldsHeadingAndDepthOfALightVehicleInALongTurn) {
  struct Light final : VehicleInfluencer {
    void influence(double, Influences& on) override { on.buoyancy_N = 0.4; }
    void link_fins(double, double, Vector3&) override {}
  } light;
  const auto motion = on_mission(
      "start.depth_m = 2\nstep = [{do = \"circle\", turns = 4, rate_deg_s = 25}, {do = \"leg\", seconds = 60}]\n",
      {.influencer = &light});
  EXPECT_NEAR(motion.at(at_s(55)).position_m[2], 2, 0.15) << "turning";
  EXPECT_NEAR(motion.at(at_s(110)).position_m[2], 2, 0.05) << "straight";
  EXPECT_NEAR(motion.at(at_s(110)).euler_rad[2], 8 * std::numbers::pi, 0.01);
}

class HeldSpeed : public ::testing::TestWithParam<double> {};

TEST_P(HeldSpeed, IsReachedWithoutKnowingTheEffects) {
  struct Weak final : VehicleInfluencer {
    void influence(double, Influences& on) override { on.thrust_factor = 0.85; }
    void link_fins(double, double, Vector3&) override {}
  } weak;
  const auto motion =
      on_mission("step = [{do = \"leg\", speed_m_s = " + std::to_string(GetParam()) + ", seconds = 60}]\n",
                 {.influencer = &weak});
  EXPECT_NEAR(motion.at(at_s(60)).velocity_body_m_s[0], GetParam(), 0.01);
}
INSTANTIATE_TEST_SUITE_P(Autopilot, HeldSpeed, ::testing::Values(0.6, 1.0, 1.4));

}  // namespace
}  // namespace navcal::sim::testing
