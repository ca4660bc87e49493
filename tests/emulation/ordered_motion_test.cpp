// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>

#include "emulation/emulate_motion.h"
#include "sim/vehicle/ordered_helm.h"

namespace navcal::emulation {
namespace {

constexpr std::int64_t kBegin_ns = 1'700'000'000'000'000'000;

struct OrderedVehicle : ::testing::Test {
  std::int64_t now_ns = kBegin_ns;
  sim::EffectSet none;
  EmulatedMotion made = ordered(none);
  const sim::Motion& motion = *made.motion;

  EmulatedMotion ordered(sim::VehicleInfluencer& influencer) {
    EmulateArguments arguments;
    arguments.ordered = true;
    return emulate_motion(arguments,
                          {.start_ns = kBegin_ns, .influencer = &influencer, .now_ns = [this] { return now_ns; }});
  }
  sim::State after(double seconds) {
    now_ns += static_cast<std::int64_t>(seconds * 1e9);
    return motion.at(now_ns);
  }
};

TEST_F(OrderedVehicle, LiesStillWithoutOrders) {
  const sim::State state = after(60);
  EXPECT_NEAR(state.position_m[0], 0, 1e-9);
  EXPECT_NEAR(state.position_m[2], sim::OrderedHelm::kSurface_m, 1e-9);
  EXPECT_EQ(state.rpm, 0);
}

TEST_F(OrderedVehicle, ALookAheadDoesNotKeepItFromObeying) {
  after(1);
  (void)motion.at(now_ns + 10'000'000'000);
  made.obey_card(now_ns, {780, {0, 0, 0}});
  EXPECT_GT(after(0.5).rpm, 400) << "an instrument that asks for the next seconds must not decide them";
}

TEST_F(OrderedVehicle, SwimsAtTheModelsSpeed) {
  made.obey_card(now_ns, {780, {0, 0, 0}});
  EXPECT_NEAR(after(60).velocity_body_m_s[0], 1.134, 0.002);
}

TEST_F(OrderedVehicle, TurnsToStarboardByAPositiveRudder) {
  made.obey_card(now_ns, {780, {-10, 5, 5}});
  EXPECT_GT(after(5).euler_rad[2], 0.3);
}

TEST_F(OrderedVehicle, DoesNotLeaveTheWater) {
  made.obey_card(now_ns, {900, {0, 13, -13}});  // nose up
  double highest_m = 0;
  for (int i = 0; i < 600; ++i) highest_m = std::max(highest_m, -after(0.1).position_m[2]);
  EXPECT_LT(highest_m, 0.5);
}

TEST_F(OrderedVehicle, EffectsActOnIt) {
  struct Current final : sim::VehicleInfluencer {
    void influence(double, sim::Influences& on) override { on.current_m_s = {0.1, 0}; }
    void link_fins(double, double, sim::Vector3&) override {}
  } current;
  const EmulatedMotion drifting = ordered(current);
  now_ns += 10'000'000'000;
  EXPECT_NEAR(drifting.motion->at(now_ns).position_m[0], 1, 0.01);
}

}  // namespace
}  // namespace navcal::emulation
