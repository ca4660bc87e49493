// SPDX-License-Identifier: Apache-2.0
// navcal simulate with a layout, given to the program as people give it: recording, decoding, log and export.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/cli/program_in_folder.h"

namespace navcal::cli {
namespace {

constexpr const char* kVehicles = NAVCAL_SOURCE_DIR "/share/vehicles/";

class SimulateLayout : public test::ProgramInFolder {
 protected:
  int simulate(const std::string& layout, const std::string& more) {
    return run_navcal("simulate --vehicle '" + layout + "' -o run.cap " + more);
  }
};

TEST_F(SimulateLayout, RecordsTheOutputsOfAnRov) {
  write(
      "hover.toml",
      "start.shaft_rpm = 0\nstart.depth_m = 1\nstep = [{do = \"leg\", seconds = 5}, {do = \"leg\", seconds = 10, "
      "speed_m_s = 0.4}]\n");
  ASSERT_EQ(simulate(std::string(kVehicles) + "bluerov2-heavy.toml",
                     "--mission ./hover.toml --truth truth.csv --report page.html --effect "
                     "thrust_scale@thruster.2=1"),
            0)
      << said("err");
  EXPECT_NE(said("page.html").find("thrust_scale of thruster.2"), std::string::npos);
  ASSERT_EQ(run_navcal("decode --device '" NAVCAL_SOURCE_DIR "/share/devices/actuator-outputs.toml' --json --port "
                       "outputs run.cap"),
            0)
      << said("err");
  EXPECT_NE(said("out").find("\"frames\":{\"PNCAO\":15"), std::string::npos) << "ten a second for some 15 s";
  // A capture of these outputs needs no description.
  ASSERT_EQ(run_navcal("decode --json --port outputs run.cap"), 0) << said("err");
  EXPECT_NE(said("out").find("\"frames\":{\"PNCAO\":15"), std::string::npos) << said("out");
  ASSERT_EQ(run_navcal("replay --json run.cap"), 0) << said("err");
  EXPECT_NE(said("out").find("\"quantity\":\"output8\",\"unit\":\"us\""), std::string::npos);
  // The log of an import contains the description of the outputs.
  ASSERT_EQ(run_navcal("log import -o run.mcap run.cap"), 0) << said("err");
  ASSERT_EQ(run_navcal("replay --json run.mcap"), 0) << said("err");
  EXPECT_NE(said("out").find("\"quantity\":\"output8\",\"unit\":\"us\""), std::string::npos);
  ASSERT_EQ(run_navcal("log export --csv csv run.mcap"), 0) << said("err");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "csv" / "sensor.csv"));
}

TEST_F(SimulateLayout, TheCaptureIsDiagnosedAsItIs) {
  const std::string layout = std::string(kVehicles) + "micro-auv.toml";
  ASSERT_EQ(simulate(layout, "--mission survey --seconds 12 --seed 2"), 0) << said("err");
  std::filesystem::rename(folder_ / "run.cap", folder_ / "nominal.cap");
  ASSERT_EQ(simulate(layout, "--mission survey --seconds 12 --seed 3"), 0) << said("err");
  ASSERT_EQ(run_navcal("gap --nominal nominal.cap --vehicle '" + layout + "' run.cap"), 0) << said("err");
  EXPECT_EQ(said("out").find("cannot be diagnosed"), std::string::npos) << said("out");
  EXPECT_NE(said("out").find("no gap"), std::string::npos) << said("out");
  EXPECT_EQ(run_navcal("gap --bank 30 --vehicle '" + layout + "' run.cap"), 2);
  EXPECT_NE(said("err").find("--nominal"), std::string::npos) << said("err");
}

TEST_F(SimulateLayout, SameSeedSameBytesAndAnEffectChangesThem) {
  const std::string layout = std::string(kVehicles) + "micro-auv.toml";
  const std::string mission = "--mission survey --seconds 20 --seed 3 ";
  ASSERT_EQ(simulate(layout, mission), 0) << said("err");
  const std::string first = said("run.cap");
  ASSERT_EQ(simulate(layout, mission), 0);
  EXPECT_EQ(said("run.cap"), first);
  ASSERT_EQ(simulate(layout, mission + "--effect damping@surge=2"), 0) << said("err");
  EXPECT_NE(said("run.cap"), first);
}

TEST_F(SimulateLayout, WhatALayoutLacksIsSaid) {
  EXPECT_EQ(simulate(std::string(kVehicles) + "slocum.toml", "--mission survey"), 3);
  EXPECT_NE(said("err").find("surge cannot be commanded, which step["), std::string::npos) << said("err");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run.cap"));
  EXPECT_EQ(simulate(std::string(kVehicles) + "bluerov2.toml", "--mission survey --effect fin_gain=1"), 2);
  EXPECT_NE(said("err").find("the layout has no surface"), std::string::npos) << said("err");
  EXPECT_EQ(
      simulate(std::string(kVehicles) + "bluerov2.toml", "--mission survey --effect thrust_scale@thruster.7=1"),
      2);
  EXPECT_NE(said("err").find("there is no thruster.7"), std::string::npos) << said("err");
  EXPECT_EQ(simulate(std::string(kVehicles) + "bluerov2.toml", "--drive x.csv"), 2);
  EXPECT_NE(said("err").find("a layout takes --mission"), std::string::npos) << said("err");
}

TEST_F(SimulateLayout, ALayoutThatCannotBeIsRefused) {
  write("light.toml",
        "[body]\nmass_kg = 10\ninertia_kg_m2 = [1, 1, 1]\nneutral = true\n[added_mass]\nmatrix = [-20, 1, 1, 1, "
        "1, 1]\n");
  EXPECT_EQ(simulate("light.toml", "--mission survey"), 3);
  EXPECT_NE(said("err").find("light.toml: cannot be simulated"), std::string::npos) << said("err");
  write("bad.toml", "[body]\nmass = 10\n");
  EXPECT_EQ(simulate("bad.toml", "--mission survey"), 3);
  EXPECT_NE(said("err").find("bad.toml:2: body.mass: unknown key"), std::string::npos) << said("err");
}

TEST_F(SimulateLayout, AVehicleThatTumblesEndsWithAMessage) {
  ASSERT_EQ(simulate(std::string(kVehicles) + "bluerov2-heavy.toml",
                     "--mission survey --seconds 100 --effects effects.toml"),
            3)
      << "no such file";
  write("effects.toml",
        "[buoyancy_shift]\nz_m = 0.2\n[[actuator_reversed]]\nof = \"thruster.5\"\nshare = 1\n"
        "[[actuator_reversed]]\nof = \"thruster.6\"\nshare = 1\n");
  EXPECT_EQ(simulate(std::string(kVehicles) + "bluerov2-heavy.toml",
                     "--mission survey --seconds 100 --effects effects.toml"),
            1);
  EXPECT_NE(said("err").find("the vehicle"), std::string::npos) << said("err");
  EXPECT_NE(said("err").find("Nothing was written"), std::string::npos) << said("err");
  write("heavy.toml", "[weight]\nmass_kg = -20\nfrom_s = 5\n");
  EXPECT_EQ(simulate(std::string(kVehicles) + "bluerov2-heavy.toml", "--mission survey --effects heavy.toml"), 3);
  EXPECT_NE(said("err").find("with its effects at 5 s: its mass is -6.5 kg"), std::string::npos) << said("err");
}

}  // namespace
}  // namespace navcal::cli
