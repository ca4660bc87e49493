// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/craft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "tests/validation/reference/thrusters/shipped_plan.h"
#include "validation/reference/instrument.h"

namespace navcal::reference::thrusters::testing {
namespace {

std::string text_of_number(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// Deep under water, tumbling.
Start tumbling() {
  Start start;
  start.position_m = {0, 0, 50};
  start.world_from_body = attitude(0.3, -0.4, 1);
  start.velocity_m_s = {0.4, -0.2, 0.3};
  start.rate_rad_s = {0.5, 0.7, -0.4};
  return start;
}

Plan without_drag(Plan plan) {
  plan.linear.setZero();
  plan.quadratic.setZero();
  plan.lift.setZero();
  plan.axial_kg_m = plan.crossflow = plan.body_lift_kg_m = 0;
  return plan;
}

class CraftOfLayout : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, CraftOfLayout, ::testing::ValuesIn(kThrusterLayouts));

TEST_P(CraftOfLayout, EnergyIsKeptWithoutDriveAndDrag) {
  Craft craft(without_drag(shipped_plan(GetParam())), {}, {}, {}, tumbling());
  const double begin_J = craft.energy_J();
  craft.advance(30);
  RecordProperty("relative_error", text_of_number(craft.energy_J() / begin_J - 1));
  EXPECT_NEAR(craft.energy_J() / begin_J, 1, 1e-8);
}

TEST_P(CraftOfLayout, DragTakesEnergy) {
  Plan plan = shipped_plan(GetParam());
  Craft craft(plan, {}, {}, {}, tumbling());
  double last_J = craft.energy_J();
  for (int second = 1; second <= 10; ++second) {
    craft.advance(second);
    EXPECT_LT(craft.energy_J(), last_J + 1e-9) << second;
    last_J = craft.energy_J();
  }
}

TEST_P(CraftOfLayout, MomentumIsKeptWithoutForces) {
  Plan plan = without_drag(shipped_plan(GetParam()));
  plan.buoyancy_N = plan.mass_kg * kGravity_m_s2;
  plan.buoyancy_centre_m = plan.gravity_centre_m;
  Craft craft(plan, {}, {}, {}, tumbling());
  // About the world's origin the moment of momentum is H + x cross P.
  const auto about_world = [&] {
    Vector6 h = craft.momentum();
    h.tail<3>() += craft.snapshot().position_m.cross(Vector3(h.head<3>()));
    return h;
  };
  const Vector6 begin = about_world();
  craft.advance(20);
  RecordProperty("relative_error", text_of_number((about_world() - begin).norm() / begin.norm()));
  EXPECT_NEAR((about_world() - begin).norm() / begin.norm(), 0, 1e-8);
}

TEST_P(CraftOfLayout, TheIntegratorConverges) {
  const Plan plan = shipped_plan(GetParam());
  const auto end_of = [&](double tolerance) {
    Craft craft(plan, {}, {}, {}, tumbling(), tolerance);
    std::vector<double> commands;
    for (const PlannedThruster& thruster : plan.thrusters)
      commands.push_back(thruster.neutral() + 0.5 * (thruster.high - thruster.neutral()));
    craft.order(commands);
    craft.advance(3);
    return craft.snapshot();
  };
  const Snapshot exact = end_of(1e-12), usual = end_of(Craft::kTolerance);
  RecordProperty("error_m", text_of_number((usual.position_m - exact.position_m).norm()));
  EXPECT_LT((usual.position_m - exact.position_m).norm(), 1e-6);
  EXPECT_LT(usual.world_from_body.angularDistance(exact.world_from_body), 1e-6);
}

TEST_P(CraftOfLayout, AStepThatIsCutGivesTheSameMotion) {
  const Plan plan = shipped_plan(GetParam());
  Craft whole(plan, {}, {}, {}, tumbling()), cut(plan, {}, {}, {}, tumbling());
  whole.advance(1);
  for (int i = 1; i <= 400; ++i) cut.advance(i * 0.0025);
  EXPECT_LT((whole.snapshot().position_m - cut.snapshot().position_m).norm(), 1e-7);
}

TEST(Craft, SpecificForceAtRestIsGravity) {
  Plan plan = shipped_plan("micro-auv");
  Rng dice(1, 1);
  Start start;
  start.position_m.z() = 5;
  const Sea sea(60 * kDegree, 0, 0, dice);
  const Craft craft(plan, {}, {}, sea, start);
  const Snapshot s = craft.snapshot();
  EXPECT_NEAR(s.gravity_m_s2, 9.8191, 1e-3);
  EXPECT_NEAR(s.acceleration_m_s2.norm(), 0, 1e-9);
}

TEST(Craft, AtTheSurfaceItFloatsWhereItsWeightIsBorne) {
  Plan plan = shipped_plan("bluerov2-heavy");
  plan.buoyancy_N = 1.25 * plan.mass_kg * kGravity_m_s2;
  Start start;
  start.position_m.z() = 0.1;
  Craft craft(plan, {}, {}, {}, start);
  craft.advance(60);
  // A fifth of its height stands out of the water.
  const double centre_m = craft.snapshot().position_m.z() + plan.buoyancy_centre_m.z();
  EXPECT_NEAR(0.5 + centre_m / plan.size_m.z(), 0.8, 0.02);
}

TEST(Craft, ACurrentCarriesAndASwellRocks) {
  Plan plan = shipped_plan("micro-auv");
  Start start;
  start.position_m.z() = 3;
  Sea sea;
  sea.set_current({0.1, -0.2});
  Craft carried(plan, {}, {}, sea, start);
  carried.advance(10);
  EXPECT_NEAR(carried.snapshot().position_m.x(), 1, 1e-6);
  EXPECT_NEAR(carried.snapshot().position_m.y(), -2, 1e-6);
  Rng dice(2, 2);
  Craft rocked(plan, {}, {}, Sea(0, 0, 0.2, dice), start);
  rocked.advance(2);
  EXPECT_GT(rocked.snapshot().velocity_m_s.norm(), 0.01);
}

TEST(Craft, DifferencesOfTheVehicleChangeItsMotion) {
  const Plan plan = shipped_plan("bluerov2-heavy");
  Start start;
  start.position_m.z() = 10;
  const auto sunk_m = [&](const CraftDeviations& deviations) {
    Craft craft(plan, deviations, {}, {}, start);
    craft.advance(10);
    return craft.snapshot().position_m.z() - 10;
  };
  const double nominal_m = sunk_m({});
  CraftDeviations heavy, light, leaking, draggy;
  heavy.mass_kg = 0.2;
  light.lift_N = 2;
  leaking.leak_N_s = 0.1;
  draggy.damping(2) = 0.5;
  EXPECT_GT(sunk_m(heavy), nominal_m + 0.05);
  EXPECT_LT(sunk_m(light), nominal_m - 0.05);
  EXPECT_GT(sunk_m(leaking), nominal_m + 0.01);
  EXPECT_LT(sunk_m(draggy), nominal_m);
}

}  // namespace
}  // namespace navcal::reference::thrusters::testing
