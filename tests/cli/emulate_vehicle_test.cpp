// SPDX-License-Identifier: Apache-2.0
// The emulated vehicle that obeys its motor card, through the program and its pseudo-terminals.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "emulate_program.h"
#include "protocols/checked_line.h"
#include "protocols/motor_card.h"
#include "tests/ports/harness.h"

namespace navcal::cli::test {
namespace {

namespace fs = std::filesystem;

std::string order_line(std::int32_t rpm, std::array<double, 3> fins_deg) {
  const auto bytes = protocols::motor_card::encode_command({rpm, fins_deg});
  return {bytes.begin(), bytes.end()};
}

struct EmulatedVehicle : ::testing::Test {
  ports::testing::Folder folder;
  fs::path dir = folder.path() / "ports", truth = folder.path() / "truth.csv";

  [[nodiscard]] std::vector<std::string> arguments(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"emulate", "--vehicle", "--dir", dir.string(), "--truth", truth.string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] std::string file(const std::string& name, std::string_view content) const {
    std::ofstream(folder.path() / name) << content;
    return (folder.path() / name).string();
  }
  /// The columns t, x, y, z, ... of each row.
  [[nodiscard]] std::vector<std::vector<double>> rows() const {
    std::ifstream in(truth);
    std::string line;
    std::vector<std::vector<double>> all;
    std::getline(in, line);
    EXPECT_EQ(line, "t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3");
    while (std::getline(in, line)) {
      std::istringstream fields(line);
      all.emplace_back();
      for (std::string field; std::getline(fields, field, ',');) all.back().push_back(std::stod(field));
    }
    return all;
  }
};

TEST_F(EmulatedVehicle, ObeysOrdersAndLeavesAWholeTruthOnCtrlC) {
  Program program(arguments({"--no-noise"}));
  ASSERT_EQ(program.line(), "ready");
  Client motor(dir / "motor");
  motor.set_speed(19200);
  motor.write(order_line(780, {-10, 5, 5}));
  EXPECT_NE(motor.read_until(",780,7").find(",780,7"), std::string::npos) << "the shaft follows";
  EXPECT_FALSE(fs::exists(truth)) << "not before it is whole";
  program.interrupt();
  EXPECT_EQ(program.wait(), 0) << program.errors();
  const auto all = rows();
  ASSERT_GT(all.size(), 50U);
  EXPECT_EQ(all.front()[7], 0) << "at rest";
  EXPECT_NEAR(all.front()[3], 0.15, 1e-9) << "at the surface";
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(all[i].size(), 17U);
    ASSERT_NEAR(all[i][0], 0.01 * static_cast<double>(i), 1e-6);
  }
  EXPECT_GT(all.back()[7], 0.3) << "it moves";
  EXPECT_GT(all.back()[6], 0.001) << "and turns to starboard";
}

TEST_F(EmulatedVehicle, TheCardRefusesFinsBeyondTheirLimit) {
  Program program(arguments());
  ASSERT_EQ(program.line(), "ready");
  Client motor(dir / "motor");
  motor.set_speed(19200);
  motor.write(order_line(780, {25.1, 0, 0}));
  motor.write(order_line(300, {0, 0, 0}));
  EXPECT_NE(motor.read_until(",300,").find(",300,"), std::string::npos);
  EXPECT_EQ(motor.read_until(",300,").find(",780,"), std::string::npos);
}

TEST_F(EmulatedVehicle, ALayoutObeysItsOutputs) {
  Program program({"emulate", "--vehicle", NAVCAL_SOURCE_DIR "/share/vehicles/bluerov2-heavy.toml", "--dir",
                   dir.string(), "--truth", truth.string(), "--no-noise"});
  ASSERT_EQ(program.line(), "ready");
  EXPECT_FALSE(fs::exists(dir / "motor"));
  Client outputs(dir / "outputs");
  outputs.set_speed(115200);
  EXPECT_NE(outputs.read_until("$PNCAO,1500,1500,1500,1500,1500,1500,1500,1500*").find("1500*"),
            std::string::npos);
  const auto line = protocols::checked_line("PNCAO,1570,1570,1570,1570,,,,");
  outputs.write(std::string(line.begin(), line.end()));
  EXPECT_NE(outputs.read_until("$PNCAO,1570,1570,1570,1570,1500").find("1570,1500"), std::string::npos);
  outputs.read_until("never", std::chrono::milliseconds(1500));
  program.interrupt();
  EXPECT_EQ(program.wait(), 0) << program.errors();
  EXPECT_GT(rows().back()[7], 0.05) << "it moves ahead";
}

TEST_F(EmulatedVehicle, ALayoutThatCannotDoItsMissionIsRefused) {
  Program program({"emulate", "--vehicle", NAVCAL_SOURCE_DIR "/share/vehicles/slocum.toml", "--mission", "survey",
                   "--dir", dir.string()});
  EXPECT_EQ(program.wait(), 3);
  EXPECT_NE(program.errors().find("surge cannot be commanded"), std::string::npos) << program.errors();
}

TEST_F(EmulatedVehicle, EffectsMoveIt) {
  const std::string effects = file("current.toml", "[water_current]\nnorth_m_s = 0.5\neast_m_s = 0\n");
  Program program(arguments({"--effects", effects, "--seconds", "3"}));
  ASSERT_EQ(program.line(), "ready");
  EXPECT_EQ(program.wait(), 0) << program.errors();
  const auto all = rows();
  ASSERT_GT(all.size(), 200U);
  EXPECT_NEAR(all.back()[1], 0.5 * all.back()[0], 0.02);
}

TEST_F(EmulatedVehicle, OneThatGoesUnstableLeavesTheTruthBeforeIt) {
  const std::string wild = file("wild.toml", "[fins]\nlift_slope_per_rad = 10\narea_m2 = 0.5\nlag_s = 0.001\n");
  Program program({"emulate", "--vehicle", wild, "--dir", dir.string(), "--truth", truth.string()});
  ASSERT_EQ(program.line(), "ready");
  Client motor(dir / "motor");
  motor.set_speed(19200);
  try {
    for (int i = 0; i < 200 && !motor.hung_up(); ++i) {
      motor.write(order_line(1800, {i % 2 == 0 ? 25.0 : -25.0, 20, -20}));
      motor.read_until("never", std::chrono::milliseconds(100));
    }
  } catch (const std::runtime_error&) {
    // The line went away between a read and a write.
  }
  EXPECT_EQ(program.wait(), 1);
  EXPECT_NE(program.errors().find("the vehicle went unstable at t = "), std::string::npos);
  EXPECT_GT(rows().size(), 2U);
}

TEST_F(EmulatedVehicle, WrongUsageIsTold) {
  const auto status = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"emulate", "--dir", dir.string()});
    Program program(options);
    const int ended = program.wait();
    return std::pair{ended, program.errors()};
  };
  EXPECT_EQ(status({"--vehicle", "--path", "x.csv"}).first, 2);
  EXPECT_EQ(status({"--vehicle", "--mission", "survey"}).first, 2);
  const auto [ended, errors] = status({"--effect", "thrust_scale=1"});
  EXPECT_EQ(ended, 2);
  EXPECT_NE(errors.find("--vehicle or --mission"), std::string::npos) << errors;
  EXPECT_EQ(status({"--vehicle", (folder.path() / "none.toml").string()}).first, 3);
  const std::string same = file("same.toml", "");
  EXPECT_EQ(status({"--vehicle", same, "--truth", same}).first, 2) << "it would write over what it reads";
}

}  // namespace
}  // namespace navcal::cli::test
