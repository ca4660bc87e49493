// SPDX-License-Identifier: Apache-2.0
// Effects of a layout: each changes what it says and nothing else, and belongs to what it names.
#include "sim/layout/effects/layout_effects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "config/layout/layout_file.h"
#include "sim/effects/document.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/layout/mass_matrix.h"

namespace navcal::sim::testing {
namespace {

config::Layout heavy_rov() { return config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/bluerov2-heavy.toml"); }

LayoutEffect effect_of(std::string_view name, std::string of, std::vector<double> values) {
  return {find_layout_effect(name), std::move(of), std::move(values)};
}

/// A layout that has every kind of part.
config::Layout with_all_parts() {
  config::Layout layout = layout_of({});
  layout.ballasts = {{.name = "ballast", .low_N = -1, .high_N = 1}};
  layout.moving_masses = {{.name = "mass", .mass_kg = 1, .low_m = -0.1, .high_m = 0.1}};
  return layout;
}

TEST(LayoutEffects, AreInOrderAndNothingOfThemIsTheNominalLayout) {
  const config::Layout nominal = with_all_parts();
  std::string_view last;
  for (const LayoutEffectDescription& about : layout_effects()) {
    EXPECT_LT(last, about.name);
    last = about.name;
    config::Layout neutral = changed_layout(nominal, {&about, {}, std::vector<double>(about.parameters.size())});
    // The added mass becomes one matrix.
    if (about.name == "added_mass") neutral.added_mass = nominal.added_mass;
    EXPECT_EQ(neutral, nominal) << about.name;
  }
}

TEST(LayoutEffects, EachChangesALayoutThatCanBeWrittenAndReadAgain) {
  const config::Layout nominal = with_all_parts();
  for (const LayoutEffectDescription& about : layout_effects()) {
    std::vector<double> values;
    for (const EffectParameter& parameter : parameters_for(nominal, about))
      values.push_back(0.5 * parameter.typical);
    const config::Layout changed = changed_layout(nominal, {&about, {}, values});
    EXPECT_NE(changed, nominal) << about.name;
    config::Layout again = config::parse_layout(config::layout_file(changed), "changed");
    again.sources.clear();
    EXPECT_EQ(config::layout_file(again), config::layout_file(changed)) << about.name;
  }
}

TEST(LayoutEffects, ADeadBandCanLoseWhatAllActuatorsHave) {
  config::Layout layout = heavy_rov();
  const auto& band = *find_layout_effect("thruster_dead_band");
  const double least = parameters_for(layout, band).front().least;
  EXPECT_LT(least, 0);
  const config::Layout without = changed_layout(layout, effect_of("thruster_dead_band", "", {2 * least}));
  for (const auto& thruster : without.thrusters) EXPECT_EQ(thruster.dead_band, 0);
  layout.thrusters[3].dead_band = 0;
  EXPECT_EQ(parameters_for(layout, band).front().least, 0);
}

TEST(LayoutEffects, BelongToTheActuatorThatTheyName) {
  const config::Layout nominal = heavy_rov();
  const auto& about = *find_layout_effect("thrust_scale");
  ASSERT_EQ(owners_of(nominal, about).size(), 8U);
  EXPECT_EQ(owners_of(nominal, about)[1], "thruster.2");
  const config::Layout by_number = changed_layout(nominal, effect_of("thrust_scale", "thruster.2", {0.5}));
  EXPECT_EQ(by_number, changed_layout(nominal, effect_of("thrust_scale", nominal.thrusters[1].name, {0.5})));
  for (std::size_t i = 0; i < nominal.thrusters.size(); ++i)
    EXPECT_EQ(by_number.thrusters[i] == nominal.thrusters[i], i != 1) << i;
  EXPECT_FALSE(owner_refusal(nominal, about, "thruster.8"));
  EXPECT_NE(owner_refusal(nominal, about, "thruster.9")->find("belongs to one of: thruster.1, thruster.2"),
            std::string::npos);
  EXPECT_EQ(owner_refusal(nominal, *find_layout_effect("fin_gain"), ""), "the layout has no surface");
}

TEST(LayoutEffects, ScaleTheThrustAtEverySpeed) {
  const config::Layout nominal = config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml");
  const LayoutVehicle one(nominal), more(changed_layout(nominal, effect_of("thrust_scale", "", {0.1})));
  for (const double speed_m_s : {0.0, 0.5, 1.0}) {
    Vector6 velocity = Vector6::Zero();
    velocity[0] = speed_m_s;
    ActuatorValues full = ActuatorValues::neutral(nominal);
    const auto force_N = [&](const LayoutVehicle& vehicle, const ActuatorValues& values) {
      return vehicle.force(velocity, Eigen::Vector3d::UnitZ(), vehicle.hold(values))[0];
    };
    const double drag_N = force_N(one, full);
    for (double& command : full.thrusters) command = 80;
    EXPECT_NEAR(force_N(more, full) - drag_N, 1.1 * (force_N(one, full) - drag_N), 1e-12);
  }
}

TEST(LayoutEffects, ActAsTheInputsOfTheSameNames) {
  const config::Layout nominal = layout_of({});
  const LayoutVehicle vehicle(nominal);
  Body body;
  body.position_m.z() = 2;
  body.velocity << 1.1, 0.1, -0.05, 0.02, 0.1, 0.3;
  const ActuatorValues actuators = Controls{{0.1, -0.05, 0.2}, 13}.values();
  const auto expect_same = [&](const LayoutEffect& effect, const Influences& influences) {
    const LayoutVehicle changed(changed_layout(nominal, effect));
    const Vector6 a = changed.step(body, actuators, 0.01).acceleration;
    const Vector6 b = vehicle.step(body, actuators, 0.01, influences).acceleration;
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-10) << effect.about->name;
  };
  expect_same(effect_of("thrust_scale", "", {0.08}), {.thrust_factor = 1.08});
  expect_same(effect_of("yaw_damping", "", {0.3}), {.yaw_damping_per_s = 0.3});
  expect_same(effect_of("buoyancy", "", {0.4}), {.buoyancy_N = 0.4});
}

TEST(LayoutEffects, ChangeHowActuatorsHearTheirCommands) {
  const config::Layout nominal = with_all_parts();
  const auto after = [&](const LayoutEffect& effect, double seconds = 100) {
    const config::Layout changed = changed_layout(nominal, effect);
    ActuatorValues commands = ActuatorValues::neutral(nominal);
    commands.thrusters = {600};
    commands.surfaces_rad = {0.2, 0.2, 0.01};
    commands.ballasts_N = {0.5};
    commands.masses_m = {0.05};
    return follow(changed, ActuatorValues::neutral(nominal), commands, seconds);
  };
  EXPECT_NEAR(after(effect_of("fin_gain", "surface.1", {0.1})).surfaces_rad[0], 0.22, 1e-9);
  EXPECT_NEAR(after(effect_of("fin_gain", "surface.1", {0.1})).surfaces_rad[1], 0.2, 1e-9);
  EXPECT_NEAR(after(effect_of("fin_offset", "surface.2", {1})).surfaces_rad[1], 0.2 + 0.017453292519943295, 1e-9);
  EXPECT_EQ(after(effect_of("fin_dead_band", "", {1})).surfaces_rad[2], 0);
  EXPECT_NEAR(after(effect_of("actuator_reversed", "surface.1", {1})).surfaces_rad[0], -0.2, 1e-9);
  EXPECT_EQ(after(effect_of("actuator_dead", "propeller", {1})).thrusters[0], 0);
  EXPECT_NEAR(after(effect_of("thruster_offset", "", {5})).thrusters[0], 600 + 0.05 * nominal.thrusters[0].high,
              1e-6);
  EXPECT_NEAR(after(effect_of("ballast_offset", "", {-0.2})).ballasts_N[0], 0.3, 1e-9);
  EXPECT_NEAR(after(effect_of("mass_scale", "", {0.5})).masses_m[0], 0.075, 1e-9);
  const double lag_s = nominal.thrusters[0].lag_s;
  EXPECT_NEAR(after(effect_of("thruster_lag", "", {0.3}), 0.1).thrusters[0],
              600 * (1 - std::exp(-0.1 / (lag_s + 0.3))), 1e-9);
}

TEST(LayoutEffects, DampingAndAddedMassChangeOneDegreeOfFreedom) {
  const config::Layout nominal = heavy_rov();
  Vector6 velocity;
  velocity << 0.5, 0.2, 0.1, 0.1, 0.2, 0.3;
  const Vector6 before = HullDamping(nominal)(velocity);
  const Vector6 after = HullDamping(changed_layout(nominal, effect_of("damping", "sway", {0.2})))(velocity);
  for (Eigen::Index i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(after[i], (i == 1 ? 1.2 : 1) * before[i]) << i;
  const config::Layout remus = config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/remus-100.toml");
  const Matrix6 heavier = added_mass(changed_layout(remus, effect_of("added_mass", "yaw", {0.44})));
  EXPECT_DOUBLE_EQ(heavier(5, 5), 1.44 * added_mass(remus)(5, 5));
  EXPECT_DOUBLE_EQ(heavier(1, 5), 1.2 * added_mass(remus)(1, 5));
  EXPECT_DOUBLE_EQ(heavier(4, 4), added_mass(remus)(4, 4));
}

TEST(LayoutEffects, OfAFileAreReadWithOwnersAndIntervals) {
  const config::Layout layout = heavy_rov();
  EffectSet set;
  std::vector<config::Problem> problems;
  add_effects(
      "[[thrust_scale]]\nof = \"thruster.2\"\nscale = -0.3\nfrom_s = 10\nuntil_s = 20\n"
      "[[thrust_scale]]\nof = \"thruster.3\"\nscale = 0.1\n[hard_iron]\nx_uT = 1\n",
      set, problems, &layout);
  ASSERT_TRUE(problems.empty()) << problems.front().message;
  ASSERT_EQ(set.layout_members().size(), 2U);
  EXPECT_EQ(set.size(), 1U);
  EXPECT_EQ(set.next_layout_change_s(0), 10);
  EXPECT_EQ(set.next_layout_change_s(10), 20);
  EXPECT_EQ(set.next_layout_change_s(20), std::numeric_limits<double>::infinity());
  config::Layout at_15 = layout;
  set.change_layout(15, at_15);
  EXPECT_EQ(at_15.thrusters[1].table_force_N[0], 0.7 * layout.thrusters[1].table_force_N[0]);
  EXPECT_EQ(at_15.thrusters[2].table_force_N[0], 1.1 * layout.thrusters[2].table_force_N[0]);
  config::Layout at_25 = layout;
  set.change_layout(25, at_25);
  EXPECT_EQ(at_25.thrusters[1], layout.thrusters[1]);
}

TEST(LayoutEffects, OfAFileThatCannotBeAreNamed) {
  const config::Layout layout = heavy_rov();
  const auto complaint = [&](std::string_view toml) {
    EffectSet set;
    std::vector<config::Problem> problems;
    add_effects(toml, set, problems, &layout);
    EXPECT_EQ(set.layout_members().size(), 0U);
    return problems.empty() ? std::string() : problems.front().message;
  };
  EXPECT_NE(complaint("[thrust_scale]\nof = \"thruster.9\"\nscale = 1\n").find("there is no thruster.9"),
            std::string::npos);
  EXPECT_NE(complaint("[thrust_scale]\nof = 2\nscale = 1\n").find("a text is expected"), std::string::npos);
  EXPECT_NE(complaint("[thrust_scale]\nscale = -2\n").find("lies between -1 and 4"), std::string::npos);
  EXPECT_NE(complaint("[fin_gain]\nscale = 0.1\n").find("no surface"), std::string::npos);
  EXPECT_NE(complaint("[elevator_offset]\nangle_deg = 1\n").find("one propeller and three fins"),
            std::string::npos);
  EXPECT_NE(complaint("[motor_field]\nx_uT_per_A = 1\n").find("does not state"), std::string::npos);
  EXPECT_NE(complaint("[weight]\nof = \"thruster.1\"\nmass_kg = 1\n").find("belongs to the whole vehicle"),
            std::string::npos);
  EXPECT_NE(complaint("[weigth]\nmass_kg = 1\n").find("did you mean weight"), std::string::npos);
}

}  // namespace
}  // namespace navcal::sim::testing
