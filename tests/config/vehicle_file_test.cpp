// SPDX-License-Identifier: Apache-2.0
// Every vehicle that a file can state comes back from it; every mistake is told with file, line and key.
#include "config/vehicle_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

namespace navcal::config {
namespace {

std::vector<std::string> problems_of_vehicle(std::string_view toml) {
  try {
    static_cast<void>(parse_vehicle(toml, "v.toml"));
    return {};
  } catch (const Error& error) {
    return error.problems();
  }
}

using Problems = std::vector<std::string>;

TEST(VehicleFile, TheShippedOneIsTheReferenceVehicleAndWrittenFromTheOptionTable) {
  const std::string file = std::string(NAVCAL_SOURCE_DIR) + "/config/vehicle.toml";
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  EXPECT_EQ(content.str(), vehicle_file({})) << "run: cmake --build DIR --target config-reference";
  EXPECT_EQ(load_vehicle(file), VehicleSettings{});
}

TEST(VehicleFile, TheShippedGainsOfThePilotAreTheDefaults) {
  EXPECT_EQ(load_vehicle(std::string(NAVCAL_SOURCE_DIR) + "/config/pilot.toml"), VehicleSettings{});
}

TEST(VehicleFile, NothingSaidIsTheReferenceVehicle) { EXPECT_EQ(parse_vehicle("", "v.toml"), VehicleSettings{}); }

TEST(VehicleFile, DefaultsAreWithinTheirOwnRangesAndEveryKeyHasAMeaning) {
  for (const auto& option : vehicle_options()) {
    Value value = option.get(VehicleSettings{});
    EXPECT_EQ(option.adopt(value), std::nullopt) << option.name();
    EXPECT_FALSE(option.description.empty()) << option.name();
    EXPECT_NO_THROW((void)option_text(option.table)) << option.table;
  }
}

TEST(VehicleFile, AnyVehicleComesBackToTheLastBit) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    VehicleSettings settings;
    for (const auto& option : vehicle_options()) {
      std::uniform_real_distribution<double> within(option.low, option.high);
      option.set(settings, Value(within(random)));
    }
    settings.hull.length_m = 2 * settings.hull.diameter_m + 1;
    ASSERT_EQ(parse_vehicle(vehicle_file(settings), "v.toml"), settings);
  }
}

TEST(VehicleFile, MistakesAreNamed) {
  EXPECT_EQ(problems_of_vehicle("[hull]\nmass_kg = -1\n"),
            Problems{"v.toml:2: hull.mass_kg: -1 is out of range: 0.1 to 10000 kg"});
  EXPECT_EQ(problems_of_vehicle("[hull]\nmas_kg = 5\n"),
            Problems{"v.toml:2: hull.mas_kg: unknown key; did you mean mass_kg?"});
  EXPECT_EQ(problems_of_vehicle("[rotor]\ndiameter_m = 5\n"), Problems{"v.toml:1: rotor: unknown key"});
  EXPECT_EQ(problems_of_vehicle("[fins]\nlag_s = \"0.1 s\"\n"),
            Problems{"v.toml:2: fins.lag_s: a number in s is expected (0.001 to 10 s), not the text \"0.1 s\""});
  EXPECT_EQ(problems_of_vehicle("[hull]\nlength_m = 0.3\ndiameter_m = 0.4\n"),
            Problems{"v.toml:3: hull.diameter_m: 0.4 m is not less than the length, 0.3 m"});
  EXPECT_EQ(problems_of_vehicle("[hull\n").size(), 1U);
  EXPECT_THROW(static_cast<void>(load_vehicle("/nowhere/v.toml")), Error);
}

}  // namespace
}  // namespace navcal::config
