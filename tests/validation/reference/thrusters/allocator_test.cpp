// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/allocator.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/validation/reference/thrusters/shipped_plan.h"
#include "validation/reference/thrusters/outputs.h"

namespace navcal::reference::thrusters::testing {
namespace {

/// Force and moment that the layout's thrusters give at rest for these pulses.
Wrench given(const Plan& plan, const std::vector<int>& pulses_us) {
  Wrench sum = Wrench::Zero();
  for (std::size_t i = 0; i < plan.thrusters.size(); ++i) {
    const PlannedThruster& t = plan.thrusters[i];
    const double thrust = t.bollard_N(command_of(t, pulses_us[i]), plan.density_kg_m3);
    const Vector3 force = thrust * t.direction;
    sum.head<3>() += force;
    sum.tail<3>() += t.place_m.cross(force) + t.reaction_sign * t.torque_arm_m * force;
  }
  return sum;
}

std::string commanded(const Allocator& allocator) {
  std::string axes;
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    if (allocator.commands(axis)) axes += "XYZKMN"[axis];
  }
  return axes;
}

TEST(Allocator, CommandsWhatTheThrustersCan) {
  EXPECT_EQ(commanded(Allocator(shipped_plan("bluerov2-heavy"))), "XYZKMN");
  EXPECT_EQ(commanded(Allocator(shipped_plan("bluerov2"))), "XYZKN") << "pitch goes with surge";
  EXPECT_EQ(commanded(Allocator(shipped_plan("micro-auv"))), "XKMN");
}

TEST(Allocator, GivesWhatIsWantedWithinTheStepOfAPulse) {
  for (const char* const name : kThrusterLayouts) {
    const Plan plan = shipped_plan(name);
    const Allocator allocator(plan);
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      if (!allocator.commands(axis)) continue;
      const auto at = static_cast<Eigen::Index>(axis);
      for (const double share : {-0.8, 0.4, 1.0}) {
        Wrench wanted = Wrench::Zero();
        wanted(at) = share * allocator.limit(axis);
        const Wrench is = given(plan, allocator.pulses_us(wanted));
        EXPECT_NEAR(is(at), wanted(at), 0.03 * allocator.limit(axis) + 0.02)
            << name << ' ' << axis << ' ' << share;
      }
    }
  }
}

TEST(Allocator, BeyondTheLimitsItStaysWithinThem) {
  const Plan plan = shipped_plan("bluerov2-heavy");
  Wrench wanted = Wrench::Constant(1e4);
  for (const int pulse : Allocator(plan).pulses_us(wanted)) {
    EXPECT_GE(pulse, 1100);
    EXPECT_LE(pulse, 1900);
  }
}

TEST(Allocator, NothingWantedIsNeutral) {
  for (const char* const name : kThrusterLayouts) {
    for (const int pulse : Allocator(shipped_plan(name)).pulses_us(Wrench::Zero())) EXPECT_EQ(pulse, 1500) << name;
  }
}

TEST(Outputs, TheLineIsThatOfTheDescription) {
  const auto text_of = [](const std::vector<int>& pulses) {
    const auto line = output_line(pulses);
    return std::string(line.begin(), line.end());
  };
  EXPECT_EQ(text_of({1500, 1620, 1500, 1500}), "$PNCAO,1500,1620,1500,1500,,,,*52\r\n");
  EXPECT_THROW((void)output_line(std::vector<int>(9, 1500)), std::invalid_argument);
}

TEST(Outputs, PulsesOfAnyUnitComeBack) {
  PlannedThruster thruster;
  thruster.low = -50;
  EXPECT_EQ(pulse_of(thruster, 100), 1900);
  EXPECT_EQ(pulse_of(thruster, -50), 1100);
  for (const double command : {-50.0, -10.0, 0.0, 33.0, 100.0})
    EXPECT_NEAR(command_of(thruster, pulse_of(thruster, command)), command, 1e-12);
  thruster.unit = OrderUnit::microseconds;
  thruster.low = 1100;
  thruster.high = 1900;
  EXPECT_EQ(pulse_of(thruster, 1623), 1623);
}

}  // namespace
}  // namespace navcal::reference::thrusters::testing
