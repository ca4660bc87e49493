// SPDX-License-Identifier: Apache-2.0
#include "validation/layout_cases.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "validation/recordings.h"

namespace navcal::validation::testing {
namespace {

NamedLayout shipped_layout(const std::string& name) {
  std::ifstream file(NAVCAL_SOURCE_DIR "/share/vehicles/" + name + ".toml");
  return {name + ".toml", {std::istreambuf_iterator<char>(file), {}}};
}

LayoutTrial shipped_layouts(std::uint64_t seed) {
  return {.layouts = {shipped_layout("bluerov2-heavy"), shipped_layout("micro-auv")},
          .seed = seed,
          .nominal = 1,
          .minutes = 0.75};
}

TrialCase case_of(const LayoutTrial& trial, int number) {
  return drawn_layout_case(trial, number, std::make_shared<LayoutVehicle>(drawn_vehicle(trial, 1)), 0);
}

TEST(LayoutCases, AreTheSameForTheSameSeed) {
  EXPECT_EQ(drawn_vehicle(shipped_layouts(3), 1).truth, drawn_vehicle(shipped_layouts(3), 1).truth);
  EXPECT_NE(drawn_vehicle(shipped_layouts(3), 1).truth, drawn_vehicle(shipped_layouts(4), 1).truth);
  EXPECT_EQ(drawn_vehicle(shipped_layouts(3), 2).layout.name, "micro-auv.toml");
  EXPECT_EQ(drawn_vehicle(shipped_layouts(3), 3).layout.name, "bluerov2-heavy.toml");
  EXPECT_EQ(truth_text(case_of(shipped_layouts(3), 2), 3), truth_text(case_of(shipped_layouts(3), 2), 3));
}

// As they were drawn for the figures of docs/validation/layout-diagnosis.md.
TEST(LayoutCases, OfTheSeedOfThePublishedFiguresAreWhatTheyWere) {
  LayoutTrial trial{.layouts = {shipped_layout("micro-auv"), shipped_layout("bluerov2-heavy")},
                    .seed = 9113,
                    .vehicles = 2,
                    .nominal = 2,
                    .minutes = 1};
  const auto cases = drawn_layout_cases(trial, {2, 7, 12}, [](double) {});
  EXPECT_EQ(cases.at(0).effects.at(0).full_name(), "actuator_reversed of thruster.3");
  EXPECT_EQ(cases.at(0).effects.at(0).of_name, "rear_starboard");
  EXPECT_DOUBLE_EQ(cases.at(1).effects.at(0).real.at("x_m"), -0.00015442152781053442);
  EXPECT_DOUBLE_EQ(cases.at(2).effects.at(0).real.at("mass_kg"), -0.54);
}

TEST(LayoutCases, ArmsAndEffectsComeByTurns) {
  const LayoutTrial trial = shipped_layouts(5);
  const auto vehicle = std::make_shared<LayoutVehicle>(drawn_vehicle(trial, 1));
  int nulls = 0;
  std::set<std::string> singles, foreign;
  for (int number = 1; number <= 320; ++number) {
    const TrialCase drawn = drawn_layout_case(trial, number, vehicle, 0);
    nulls += drawn.arm == TrialArm::nulls ? 1 : 0;
    EXPECT_EQ(drawn.effects.empty(), drawn.arm == TrialArm::nulls);
    EXPECT_EQ(drawn.excluded.empty(), drawn.arm != TrialArm::removed);
    EXPECT_EQ(drawn.effects.size() == 2, drawn.arm == TrialArm::pairs);
    for (const auto& effect : drawn.effects) {
      const auto* const kind = reference::thrusters::find_craft_effect(effect.name);
      ASSERT_NE(kind, nullptr) << effect.name;
      EXPECT_EQ(kind->in_library, drawn.arm != TrialArm::foreign) << effect.name;
      if (drawn.arm == TrialArm::single) singles.insert(effect.name);
      if (drawn.arm == TrialArm::foreign) foreign.insert(effect.name);
    }
  }
  EXPECT_EQ(nulls, 100);
  EXPECT_EQ(foreign.size(), 9U);
  EXPECT_GE(singles.size(), 30U);
}

TEST(LayoutCases, TruthNamesTheThrusterAndWhatTheVehicleIs) {
  LayoutTrial trial = shipped_layouts(3);
  trial.layout_error = 0.1;
  TrialCase drawn = case_of(trial, 1);
  drawn.effects = {{"actuator_dead", {}, {}, "thruster.3", "rear_starboard"}};
  const auto truth = nlohmann::json::parse(truth_text(drawn, 3));
  const auto& real = truth.at("vehicle").at("real");
  EXPECT_NE(real.at("mass_kg").get<double>(), 13.5);
  EXPECT_NEAR(real.at("mass_kg").get<double>(), 13.5, 1.4);
  EXPECT_EQ(real.at("thrusters").size(), 8U);
  EXPECT_EQ(truth.at("drawn").at(0).at("of"), "thruster.3");
  EXPECT_EQ(truth.at("drawn").at(0).at("of_name"), "rear_starboard");
}

TEST(LayoutCases, WithoutErrorTheVehicleIsItsLayout) {
  LayoutTrial trial = shipped_layouts(3);
  trial.layout_error = 0;
  const LayoutVehicle vehicle = drawn_vehicle(trial, 1);
  EXPECT_DOUBLE_EQ(vehicle.craft.real.mass_kg, vehicle.craft.layout.mass_kg);
  EXPECT_DOUBLE_EQ(vehicle.craft.real.thrusters[0].lag_s, vehicle.craft.layout.thrusters[0].lag_s);
}

TEST(LayoutCases, ADataSheetHasTheErrorsOfItsNumbers) {
  LayoutVehicle vehicle;
  vehicle.layout_error = 0.04;
  vehicle.craft.layout.gravity_centre_m = {0, 0, 0.005};
  vehicle.layout.text =
      "[body]\nmass_kg = 2  # [1] more\nmass_kg_std = 1\ngravity_centre_m = [0, 0, 0.005]\n"
      "linear = [0.5, -1, 0]\ncoefficient_range = [0.6, 1.5]\n[[thruster]]\nlag_s = 0.1\nmatrix = [\n  1, 2]";
  EXPECT_EQ(data_sheet(vehicle),
            "[body]\nmass_kg = 2  # [1] more\nmass_kg_std = 0.02\ngravity_centre_m = [0, 0, 0.005]\n"
            "gravity_centre_m_std = [0.0002, 0.0002, 0.0002]\nlinear = [0.5, -1, 0]\n"
            "linear_std = [0.04, 0.08, 0]\n[[thruster]]\nforce_scale = 1\nforce_scale_std = 0.04\nlag_s = 0.1\n"
            "lag_s_std = 0.008\nmatrix = [\n  1, 2]\n");
}

TEST(LayoutCases, LayoutsThatCannotBeFlownAreRefusedByName) {
  try {
    (void)drawn_vehicle({.layouts = {shipped_layout("remus-100")}}, 1);
    FAIL() << "it has surfaces";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("remus-100.toml"), std::string::npos) << error.what();
  }
}

TEST(LayoutRecordings, ACaptureHasAllPorts) {
  const std::string text = capture_of(drawn_vehicle(shipped_layouts(3), 2).nominals.at(0));
  for (const char* const port : {"#port compass tcm2", "#port imu imu-card", "#port gps oncore",
                                 "#port doppler waterlinked", "#port actuators described"})
    EXPECT_NE(text.find(port), std::string::npos) << port;
  EXPECT_EQ(text.find("#truth"), std::string::npos);
}

}  // namespace
}  // namespace navcal::validation::testing
