// SPDX-License-Identifier: Apache-2.0
#include "emulation/chosen_vehicle.h"

#include <gtest/gtest.h>

#include <fstream>

#include "config/vehicle_file.h"
#include "tests/support/temporary_folder.h"

namespace navcal::emulation {
namespace {

// Nominal recordings were refused for every vehicle but a layout.
TEST(ChosenVehicle, IsDiagnosedAsALayoutWhereThereAreNominalRecordings) {
  const std::filesystem::path layout = NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml";
  for (const bool has_nominals : {false, true}) {
    EXPECT_TRUE(layout_to_diagnose(layout, has_nominals).has_value());
    EXPECT_EQ(layout_to_diagnose({}, has_nominals).has_value(), has_nominals) << "the reference vehicle";
  }
  const test::TemporaryFolder folder;
  config::VehicleSettings heavy;
  heavy.hull.mass_kg = 7;
  std::ofstream(folder / "vehicle.toml") << config::vehicle_file(heavy);
  EXPECT_FALSE(layout_to_diagnose(folder / "vehicle.toml", false).has_value());
  EXPECT_EQ(layout_to_diagnose(folder / "vehicle.toml", true).value().body.mass_kg, 7);
}

}  // namespace
}  // namespace navcal::emulation
