// SPDX-License-Identifier: Apache-2.0
// The second reality against what navcal vehicle check says of the same file: both read it by themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "config/layout/layout_file.h"
#include "sim/layout/assessment/assessment.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/layout/mass_matrix.h"
#include "tests/validation/reference/thrusters/shipped_plan.h"
#include "validation/reference/thrusters/craft.h"
#include "validation/reference/thrusters/outputs.h"
#include "validation/reference/thrusters/swim.h"

namespace navcal::reference::thrusters::testing {
namespace {

config::Layout layout_of_file(const std::string& name) {
  return config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/" + name + ".toml");
}

std::vector<double> commands_of(const Plan& plan, double share) {
  std::vector<double> commands;
  for (const PlannedThruster& thruster : plan.thrusters)
    commands.push_back(thruster.neutral() + share * (thruster.high - thruster.neutral()));
  return commands;
}

class LayoutAgreement : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, LayoutAgreement, ::testing::ValuesIn(kThrusterLayouts));

TEST_P(LayoutAgreement, MassAndAddedMassAreTheSame) {
  const config::Layout layout = layout_of_file(GetParam());
  const Plan plan = shipped_plan(GetParam());
  EXPECT_NEAR((plan.added_mass - sim::added_mass(layout)).norm() / plan.added_mass.norm(), 0, 1e-9);
  EXPECT_NEAR(plan.buoyancy_N, layout.body.buoyancy_N, 1e-9);
}

TEST_P(LayoutAgreement, SteadySpeedAheadIsWithinOnePerCent) {
  // The check holds all other motion; here a stiff drag across does (the Munk moment would turn the vehicle).
  const sim::Assessment found = sim::assess(layout_of_file(GetParam()));
  Plan plan = shipped_plan(GetParam());
  constexpr double kHeld_per_s = 100;
  const Matrix6 M = inertia(plan);
  for (Eigen::Index axis = 1; axis < 6; ++axis) plan.linear(axis, axis) = kHeld_per_s * M(axis, axis);
  std::erase_if(plan.thrusters, [](const PlannedThruster& t) { return t.direction.x() < 0.1; });
  Start start;
  start.position_m.z() = 30;
  plan.buoyancy_N = plan.mass_kg * kGravity_m_s2;
  int compared = 0;
  double worst = 0;
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    Craft craft(plan, {}, {}, {}, start);
    craft.order(commands_of(plan, share));
    craft.advance(60);
    const std::string begin = std::to_string(std::lround(100 * share)) + " % command";
    for (const sim::SteadySpeed& speed : found.ahead) {
      if (speed.what.find(begin) == std::string::npos || !speed.speed_m_s || *speed.speed_m_s <= 0) continue;
      EXPECT_NEAR(craft.snapshot().velocity_m_s.x() / *speed.speed_m_s, 1, 0.01) << speed.what;
      worst = std::max(worst, std::abs(craft.snapshot().velocity_m_s.x() / *speed.speed_m_s - 1));
      ++compared;
    }
  }
  EXPECT_GE(compared, 3);
  RecordProperty("worst_deviation_percent", std::to_string(100 * worst));
}

TEST_P(LayoutAgreement, AtRestItTrimsAndSinksAsTheCheckSays) {
  const sim::Assessment found = sim::assess(layout_of_file(GetParam()));
  const Plan plan = shipped_plan(GetParam());
  Start start;
  start.position_m.z() = 30;
  start.world_from_body = attitude(0.02, -0.02, 0.5);
  Craft craft(plan, {}, {}, {}, start);
  craft.advance(120);
  const Snapshot end = craft.snapshot();
  EXPECT_NEAR(end.roll_rad(), found.statics.roll_rad, 0.01);
  EXPECT_NEAR(end.pitch_rad(), found.statics.pitch_rad, 0.01);
  double sinking_m_s = 0;
  for (const sim::SteadySpeed& speed : found.downwards) {
    if (speed.what.find("neutral") != std::string::npos) sinking_m_s = speed.speed_m_s.value_or(0);
  }
  RecordProperty("sinking_m_s", std::to_string(end.ground_velocity_m_s().z()));
  RecordProperty("sinking_stated_m_s", std::to_string(sinking_m_s));
  EXPECT_NEAR(end.ground_velocity_m_s().z(), sinking_m_s, 0.01 * std::abs(sinking_m_s) + 1e-4);
}

TEST_P(LayoutAgreement, ForTwoSecondsBothMoveAlike) {
  // Rotors, wakes and strips differ, so the paths may: by 5 % of the way, not by more.
  const config::Layout layout = layout_of_file(GetParam());
  const sim::LayoutVehicle model(layout);
  const Plan plan = shipped_plan(GetParam());
  sim::Body body;
  body.position_m.z() = 20;
  sim::LayoutRun model_run(model, body);
  sim::ActuatorValues values = model_run.positions();
  values.thrusters = commands_of(plan, 0.4);
  model_run.advance(values, 2);
  Start start;
  start.position_m.z() = 20;
  Craft craft(plan, {}, {}, {}, start);
  craft.order(commands_of(plan, 0.4));
  craft.advance(2);
  const Vector3 way = model_run.body().position_m - body.position_m;
  EXPECT_GT(way.norm(), 0.1);
  const double apart_m = (craft.snapshot().position_m - model_run.body().position_m).norm();
  RecordProperty("apart_percent_of_the_way", std::to_string(100 * apart_m / way.norm()));
  EXPECT_LT(apart_m, 0.05 * way.norm());
}

/// The true states and the commands of a mission.
struct SwimTrack : Sink {
  std::vector<Snapshot> truths;
  std::vector<std::vector<double>> pulses;
  void transfer(const Transfer& transfer) override {
    if (transfer.port != Port::actuators) return;
    std::istringstream line(std::string(transfer.bytes.begin() + 7, transfer.bytes.end()));
    pulses.emplace_back();
    for (std::string field; std::getline(line, field, ',') && !field.empty() && field[0] != '*';)
      pulses.back().push_back(std::stod(field));
  }
  void truth(const Snapshot& snapshot) override { truths.push_back(snapshot); }
};

sim::Body body_of(const Snapshot& s) {
  sim::Body body;
  body.position_m = s.position_m;
  body.euler_rad = {s.roll_rad(), s.pitch_rad(), s.heading_rad()};
  body.velocity << s.velocity_m_s, s.rate_rad_s;
  return body;
}

TEST_P(LayoutAgreement, OverATenthOfASecondTheModelPredictsMostOfTheMotion) {
  // What no layout has a number for: the part of each change of velocity that the layout's model, begun in the
  // true state, does not predict. A diagnosis has to bear it.
  const config::Layout layout = layout_of_file(GetParam());
  const sim::LayoutVehicle model(layout);
  CraftUnderTest craft;
  craft.layout = craft.real = shipped_plan(GetParam());
  Rng dice(1, 9);
  Swim swim;
  swim.duration_s = 90;
  swim.legs = drawn_legs(craft.layout, swim.duration_s, dice);
  swim.start.position_m.z() = 0.3;
  SwimTrack track;
  ASSERT_FALSE(run(swim, craft, 1, track));

  constexpr double kTick_s = Pilot::kPeriod_s, kModelStep_s = 0.01;
  sim::ActuatorValues positions = sim::ActuatorValues::neutral(layout), commands = positions;
  sim::Vector6 missed2 = sim::Vector6::Zero(), changed2 = sim::Vector6::Zero();
  const std::size_t begin = track.truths.size() - track.pulses.size() - 1;  // ticks before the first command
  for (std::size_t i = 0; i < track.pulses.size(); ++i) {
    for (std::size_t k = 0; k < track.pulses[i].size(); ++k)
      commands.thrusters[k] = command_of(craft.layout.thrusters[k], track.pulses[i][k]);
    sim::Body body = body_of(track.truths[begin + i]);
    for (int step = 0; step < std::lround(kTick_s / kModelStep_s); ++step) {
      const sim::ActuatorValues next = sim::follow(layout, positions, commands, kModelStep_s);
      body = model.step(body, sim::mean_of(positions, next), kModelStep_s).body;
      positions = next;
    }
    const sim::Vector6 is = body_of(track.truths[begin + i + 1]).velocity;
    missed2 += (is - body.velocity).cwiseAbs2();
    changed2 += (is - body_of(track.truths[begin + i]).velocity).cwiseAbs2();
  }
  const auto count = static_cast<double>(track.pulses.size());
  const sim::Vector6 missed = (missed2 / count).cwiseSqrt() / kTick_s,
                     changed = (changed2 / count).cwiseSqrt() / kTick_s;
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    const char* const name =
        std::array{"surge", "sway", "heave", "roll", "pitch", "yaw"}[static_cast<std::size_t>(axis)];
    RecordProperty(std::string(name) + "_missed", std::to_string(missed(axis)));
    RecordProperty(std::string(name) + "_changed", std::to_string(changed(axis)));
    EXPECT_LT(missed(axis), 0.3 * changed(axis) + 0.01) << name;
  }
}

}  // namespace
}  // namespace navcal::reference::thrusters::testing
