// SPDX-License-Identifier: Apache-2.0
#include "autopilot/autopilot.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/angles.h"

namespace navcal::autopilot::testing {
namespace {

TEST(Autopilot, MixingIsThatOfTheCardsDocument) {
  const Eigen::Vector3d fins = mixed_fins(0.2, 0.1);
  EXPECT_DOUBLE_EQ(2.0 / 3 * ((fins[1] + fins[2]) / 2 - fins[0]), 0.2) << "the rudder comes back";
  EXPECT_DOUBLE_EQ((fins[1] - fins[2]) / std::numbers::sqrt3, 0.1) << "the elevator comes back";
}

TEST(Autopilot, OrdersAreWithinWhatFinsAndShaftCanDo) {
  const config::VehicleSettings vehicle;
  Autopilot autopilot{vehicle};
  VehicleState state;
  state.depth_m = 100;
  const Demand far{.heading_rad = 100, .depth_m = 0, .shaft_rps = 1e3};
  const Orders orders = autopilot.orders(far, state, vehicle.autopilot.period_s);
  for (const double fin : orders.fins_rad) EXPECT_LE(std::abs(fin) * base::kDegreesPerRadian, 25 + 1e-9);
  EXPECT_DOUBLE_EQ(orders.shaft_rps, 30);
}

}  // namespace
}  // namespace navcal::autopilot::testing
