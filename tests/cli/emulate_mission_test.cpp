// SPDX-License-Identifier: Apache-2.0
// Missions and vehicles given to the live instruments.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <tuple>

#include "emulate_program.h"
#include "tests/ports/harness.h"

namespace navcal::cli::test {
namespace {

namespace fs = std::filesystem;

struct EmulateMission : ::testing::Test {
  ports::testing::Folder folder;
  fs::path dir = folder.path() / "ports";

  [[nodiscard]] std::string file(const std::string& name, std::string_view content) const {
    std::ofstream(folder.path() / name) << content;
    return (folder.path() / name).string();
  }
};

/// Status and standard error of a run that ends by itself.
std::pair<int, std::string> outcome(std::vector<std::string> options, const fs::path& dir) {
  options.insert(options.begin(), {"emulate", "--dir", dir.string()});
  Program program(options);
  const int status = program.wait();
  return {status, program.errors()};
}

TEST_F(EmulateMission, TheMotorCardReportsWhatTheMissionOrders) {
  const std::string mission =
      file("turn.toml",
           "start.shaft_rpm = 600\n"
           "step = [{do = \"direct\", rudder_deg = 10, elevator_deg = 0, seconds = 60}]\n");
  Program program({"emulate", "--dir", dir.string(), "--mission", mission});
  ASSERT_EQ(program.line(), "ready");
  Client motor(dir / "motor");
  EXPECT_NE(motor.read_until(",600,600,-10.").find(",600,600,-10."), std::string::npos);
}

TEST_F(EmulateMission, AVehicleOfItsOwnIsTaken) {
  const std::string vehicle = file("stiff.toml", "[fins]\nlimit_deg = 3\n");
  const std::string mission =
      file("turn.toml", "step = [{do = \"direct\", rudder_deg = 10, elevator_deg = 0, seconds = 60}]\n");
  Program program({"emulate", "--dir", dir.string(), "--mission", mission, "--vehicle", vehicle});
  ASSERT_EQ(program.line(), "ready");
  Client motor(dir / "motor");
  EXPECT_NE(motor.read_until(",780,780,-3.").find(",780,780,-3."), std::string::npos);
}

TEST_F(EmulateMission, MistakesAreToldWithFileAndLine) {
  const std::string mission = file("bad.toml", "[[step]]\ndo = \"leg\"\n");
  auto [status, errors] = outcome({"--mission", mission}, dir);
  EXPECT_EQ(status, 3);
  EXPECT_NE(errors.find("bad.toml:1: step[1]: seconds or metres is missing"), std::string::npos) << errors;
  std::tie(status, errors) = outcome({"--mission", "nonesuch"}, dir);
  EXPECT_EQ(status, 3);
  EXPECT_NE(errors.find("known: calibration_swing, identification, survey"), std::string::npos) << errors;
  std::tie(status, errors) = outcome({"--mission", "survey", "--path", "x.csv"}, dir);
  EXPECT_EQ(status, 2);
}

TEST_F(EmulateMission, AVehicleThatGoesUnstableEndsItWithTimeAndState) {
  const std::string vehicle = file("wild.toml", "[fins]\nlift_slope_per_rad = 10\narea_m2 = 0.5\nlag_s = 0.001\n");
  const auto [status, errors] = outcome({"--mission", "survey", "--vehicle", vehicle, "--seconds", "30"}, dir);
  EXPECT_EQ(status, 1);
  EXPECT_NE(errors.find("the vehicle went unstable at t = "), std::string::npos) << errors;
}

}  // namespace
}  // namespace navcal::cli::test
