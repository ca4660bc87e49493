// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/ordered_helm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace navcal::sim::testing {
namespace {

constexpr double kHelmStep_s = 0.01;

struct Ordered : ::testing::Test {
  OrderedHelm helm{config::VehicleSettings{}};
  Actuators now{helm.positions_at_start(), helm.positions_at_start(), {}, false};
  int steps = 0;

  [[nodiscard]] double shaft_rps() const { return now.positions.thrusters[0] / 60; }

  void run(double seconds) {
    const long count = std::lround(seconds / kHelmStep_s);
    for (long i = 0; i < count; ++i) helm.next(kHelmStep_s * steps++, kHelmStep_s, {}, now);
  }
};

TEST_F(Ordered, BeginsAtRestAtTheSurface) {
  const Body body = helm.start();
  EXPECT_EQ(body.velocity, Vector6::Zero());
  EXPECT_LT(body.position_m.z(), 0.35) << "GPS is heard";
  EXPECT_EQ(helm.positions_at_start().thrusters[0], 0);
  run(5);
  EXPECT_EQ(shaft_rps(), 0);
  EXPECT_EQ(now.positions.surfaces_rad, ActuatorNumbers({0, 0, 0}));
}

TEST_F(Ordered, FollowsAnOrderWithTheLagsOfTheVehicle) {
  helm.order(1, {780, 0.1, -0.1, 0.2});
  run(1);
  EXPECT_EQ(shaft_rps(), 0) << "not before its time";
  run(0.5);
  EXPECT_NEAR(shaft_rps(), 13 * (1 - std::exp(-1.0)), 1e-9);
  EXPECT_NEAR(now.positions.surfaces_rad[2], 0.2 * (1 - std::exp(-0.5 / 0.15)), 1e-9);
  EXPECT_EQ(now.commands.thrusters[0], 780);
}

TEST_F(Ordered, ALateOrderCountsFromTheNextStepOn) {
  run(2);
  helm.order(1, {780, 0, 0, 0});
  run(kHelmStep_s);
  EXPECT_NEAR(shaft_rps(), 13 * (1 - std::exp(-kHelmStep_s / 0.5)), 1e-9);
}

TEST_F(Ordered, LimitsTheShaftsAccelerationAndSpeed) {
  helm.order(0, {30000, 0, 0, 0});
  double before_rps = 0, greatest = 0;
  for (int i = 0; i < 1000; ++i) {
    run(kHelmStep_s);
    greatest = std::max(greatest, (shaft_rps() - before_rps) / kHelmStep_s);
    before_rps = shaft_rps();
  }
  EXPECT_NEAR(greatest, OrderedHelm::kGreatestAcceleration_rps_s, 1e-6);
  EXPECT_NEAR(shaft_rps(), 30, 1e-3) << "the shaft's limit of the vehicle's file";
  EXPECT_EQ(now.commands.thrusters[0], 1800);
}

}  // namespace
}  // namespace navcal::sim::testing
