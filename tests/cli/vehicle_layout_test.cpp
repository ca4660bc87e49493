// SPDX-License-Identifier: Apache-2.0
// navcal vehicle check and convert, given to the program as people give them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

class VehicleLayout : public testing::Test {
 protected:
  int run_vehicle(const std::string& arguments) {
    const std::string command = "cd '" + folder_.path().string() + "' && '" NAVCAL_PROGRAM "' vehicle " +
                                arguments + " > out 2> err < /dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string said(const std::string& file) const { return navcal::test::read_file(folder_ / file); }
  void write(const std::string& file, const std::string& text) const { std::ofstream(folder_ / file) << text; }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(VehicleLayout, CheckShowsAShippedLayout) {
  ASSERT_EQ(run_vehicle("check '" NAVCAL_SOURCE_DIR "/share/vehicles/reference.toml'"), 0) << said("err");
  EXPECT_NE(said("out").find("metacentric height   0.01 m (stable)"), std::string::npos) << said("out");
  EXPECT_NE(said("out").find("nothing odd"), std::string::npos) << said("out");
}

TEST_F(VehicleLayout, CheckWritesJson) {
  ASSERT_EQ(run_vehicle("check --json '" NAVCAL_SOURCE_DIR "/share/vehicles/remus-100.toml'"), 0) << said("err");
  const auto json = nlohmann::json::parse(said("out"));
  EXPECT_TRUE(json.at("simulable").get<bool>());
  EXPECT_NEAR(json.at("statics").at("mass_kg").get<double>(), 30.48, 1e-9);
  EXPECT_NEAR(json.at("ahead").back().at("speed_m_s").get<double>(), 1.54, 0.01);
  EXPECT_EQ(json.at("allocation").size(), 2U);
  EXPECT_EQ(json.at("allocation").at(1).at("commanded").at("yaw"), "with others");
}

TEST_F(VehicleLayout, WhatCannotBeSimulatedEndsWithStatusOne) {
  write("v.toml",
        "[body]\nmass_kg = 10\ninertia_kg_m2 = [1, 1, 1]\nneutral = true\n[added_mass]\n"
        "matrix = [-20, 1, 1, 1, 1, 1]\n");
  EXPECT_EQ(run_vehicle("check v.toml"), 1);
  EXPECT_NE(said("err").find("not positive definite"), std::string::npos) << said("err");
  EXPECT_NE(said("out").find("added_mass.matrix"), std::string::npos) << said("out");
}

TEST_F(VehicleLayout, WhatCannotBeReadEndsWithStatusThree) {
  write("v.toml", "[body]\nmass = 10\n");
  EXPECT_EQ(run_vehicle("check v.toml"), 3);
  EXPECT_NE(said("err").find("v.toml:2: body.mass: unknown key; did you mean mass_kg?"), std::string::npos)
      << said("err");
  EXPECT_EQ(run_vehicle("check nothing.toml"), 3);
}

TEST_F(VehicleLayout, ConvertWritesALayoutThatCheckReads) {
  write("vehicle.toml", "hull.mass_kg = 6\n");
  ASSERT_EQ(run_vehicle("convert vehicle.toml -o layout.toml"), 0) << said("err");
  ASSERT_EQ(run_vehicle("check --json layout.toml"), 0) << said("err");
  EXPECT_NEAR(nlohmann::json::parse(said("out")).at("statics").at("mass_kg").get<double>(), 6, 1e-12);
  EXPECT_EQ(run_vehicle("convert vehicle.toml -o vehicle.toml"), 2) << "it would be written over";
}

TEST_F(VehicleLayout, AVehicleUnstableInYawThatIsHeldStraightHasNoWrongSign) {
  // Its receiver's velocity is noisy, and by a wrong sway it would turn within a second.
  const std::string layout = NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml";
  for (const std::string seed : {"2", "3", "5"}) {
    const std::string simulated =
        "cd '" + folder_.path().string() + "' && '" NAVCAL_PROGRAM "' simulate --vehicle '" + layout +
        "' --mission survey --seconds 60 --seed " + seed + " -o dive" + seed + ".cap > out 2> err < /dev/null";
    ASSERT_EQ(std::system(simulated.c_str()), 0) << said("err");
    ASSERT_EQ(run_vehicle("check --json '" + layout + "' dive" + seed + ".cap"), 0) << said("err");
    EXPECT_TRUE(nlohmann::json::parse(said("out")).at("conventions").empty()) << seed << said("out");
  }
}

}  // namespace
}  // namespace navcal::cli
