// SPDX-License-Identifier: Apache-2.0
#include "validation/layout_cases.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "validation/layout_recordings.h"

namespace navcal::validation::testing {
namespace {

NamedLayout shipped_layout(const std::string& name) {
  std::ifstream file(NAVCAL_SOURCE_DIR "/share/vehicles/" + name + ".toml");
  return {name + ".toml", {std::istreambuf_iterator<char>(file), {}}};
}

const std::vector<NamedLayout>& shipped_layouts() {
  static const std::vector<NamedLayout> kLayouts{shipped_layout("bluerov2-heavy"), shipped_layout("micro-auv")};
  return kLayouts;
}

TEST(LayoutCases, AreTheSameForTheSameSeed) {
  const LayoutVehicleCase one = drawn_vehicle(3, 1, shipped_layouts(), {});
  const LayoutVehicleCase again = drawn_vehicle(3, 1, shipped_layouts(), {});
  EXPECT_EQ(truth_text(one, 3, {}), truth_text(again, 3, {}));
  EXPECT_NE(truth_text(one, 3, {}), truth_text(drawn_vehicle(4, 1, shipped_layouts(), {}), 3, {}));
  EXPECT_EQ(drawn_vehicle(3, 2, shipped_layouts(), {}).layout.name, "micro-auv.toml");
  EXPECT_EQ(drawn_vehicle(3, 3, shipped_layouts(), {}).layout.name, "bluerov2-heavy.toml");
  EXPECT_EQ(truth_text(drawn_layout_case(3, 2, one, 0), 3), truth_text(drawn_layout_case(3, 2, one, 0), 3));
}

TEST(LayoutCases, ArmsAndEffectsComeByTurns) {
  const LayoutVehicleCase vehicle = drawn_vehicle(5, 1, shipped_layouts(), {});
  int nulls = 0;
  std::set<std::string> singles, foreign;
  for (int number = 1; number <= 320; ++number) {
    const LayoutCase drawn = drawn_layout_case(5, number, vehicle, 0);
    nulls += drawn.arm == LayoutArm::nulls ? 1 : 0;
    EXPECT_EQ(drawn.effects.empty(), drawn.arm == LayoutArm::nulls);
    EXPECT_EQ(drawn.excluded.empty(), drawn.arm != LayoutArm::removed);
    EXPECT_EQ(drawn.effects.size() == 2, drawn.arm == LayoutArm::pairs);
    for (const auto& effect : drawn.effects) {
      const auto* const kind = reference::thrusters::find_craft_effect(effect.name);
      ASSERT_NE(kind, nullptr) << effect.name;
      EXPECT_EQ(kind->in_library, drawn.arm != LayoutArm::foreign) << effect.name;
      if (drawn.arm == LayoutArm::single) singles.insert(effect.name);
      if (drawn.arm == LayoutArm::foreign) foreign.insert(effect.name);
    }
  }
  EXPECT_EQ(nulls, 100);
  EXPECT_EQ(foreign.size(), 9U);
  EXPECT_GE(singles.size(), 30U);
}

TEST(LayoutCases, TruthNamesTheThrusterAndWhatTheVehicleIs) {
  const LayoutVehicleCase vehicle = drawn_vehicle(3, 1, shipped_layouts(), {.layout = 0.1});
  const auto truth = nlohmann::json::parse(truth_text(vehicle, 3, {}));
  EXPECT_NE(truth.at("real").at("mass_kg").get<double>(), 13.5);
  EXPECT_NEAR(truth.at("real").at("mass_kg").get<double>(), 13.5, 1.4);
  EXPECT_EQ(truth.at("real").at("thrusters").size(), 8U);
  LayoutCase drawn = drawn_layout_case(3, 1, vehicle, 0);
  drawn.effects = {{"actuator_dead", "thruster.3", {}}};
  const auto effect = nlohmann::json::parse(truth_text(drawn, 3)).at("effects").at(0);
  EXPECT_EQ(effect.at("of"), "thruster.3");
  EXPECT_EQ(effect.at("of_name"), "rear_starboard");
}

TEST(LayoutCases, WithoutErrorTheVehicleIsItsLayout) {
  const LayoutVehicleCase vehicle = drawn_vehicle(3, 1, shipped_layouts(), {.layout = 0});
  EXPECT_DOUBLE_EQ(vehicle.craft.real.mass_kg, vehicle.craft.layout.mass_kg);
  EXPECT_DOUBLE_EQ(vehicle.craft.real.thrusters[0].lag_s, vehicle.craft.layout.thrusters[0].lag_s);
}

TEST(LayoutCases, LayoutsThatCannotBeFlownAreRefusedByName) {
  const std::vector<NamedLayout> wrong{shipped_layout("remus-100")};
  try {
    (void)drawn_vehicle(1, 1, wrong, {});
    FAIL() << "it has surfaces";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("remus-100.toml"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)layout_arm_named("none"), std::invalid_argument);
}

TEST(LayoutRecordings, ACaptureHasAllPorts) {
  const LayoutVehicleCase vehicle = drawn_vehicle(3, 2, shipped_layouts(), {});
  const std::string text = capture_of(drawn_swim(vehicle, 9, 45, 1), nominal_day(3, vehicle, 1), 9);
  for (const char* const port : {"#port compass tcm2", "#port imu imu-card", "#port gps oncore",
                                 "#port doppler waterlinked", "#port actuators described"})
    EXPECT_NE(text.find(port), std::string::npos) << port;
  EXPECT_EQ(text.find("#truth"), std::string::npos);
}

}  // namespace
}  // namespace navcal::validation::testing
