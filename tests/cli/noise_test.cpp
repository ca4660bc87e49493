// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "config/load.h"
#include "tests/cli/command_outcome.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

constexpr const char* kPathHead = "t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3\n";

class NoiseCommand : public ::testing::Test {
 protected:
  test::Outcome noise(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "noise");
    return test::run_command(add_noise, std::move(arguments));
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return path(name);
  }
  /// A capture of a vehicle that moves along a path.
  std::string simulated(const std::string& csv, int seconds, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{
        "simulate", "--path",        write("path.csv", csv), "--seconds", std::to_string(seconds),
        "-o",       path("made.cap")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = test::run_command(add_simulate, arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.message;
    return path("made.cap");
  }
  nlohmann::json answer(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const auto outcome = noise(std::move(arguments));
    EXPECT_EQ(outcome.status, 0) << outcome.message;
    return nlohmann::json::parse(outcome.output);
  }
  static std::string still() {
    return std::string(kPathHead) + "0,0,0,0,0,0,0.5,0,0,0,0,0,0,0,0,0,0\n10,0,0,0,0,0,0.5,0,0,0,0,0,0,0,0,0,0\n";
  }
  /// At rest, but between two times the bow swings.
  static std::string swinging(double from_s, double to_s, double end_s) {
    std::string csv = kPathHead;
    for (int i = 0; i * 0.1 <= end_s; ++i) {
      const double time_s = i * 0.1, phase = 2 * 3.14159265 * 0.2 * (time_s - from_s);
      const bool moves = time_s > from_s && time_s < to_s;
      csv += std::to_string(time_s) + ",0,0,0,0,0," + std::to_string(moves ? 0.5 * std::sin(phase) : 0.0) +
             ",0,0,0,0,0," + std::to_string(moves ? 0.5 * 2 * 3.14159265 * 0.2 * std::cos(phase) : 0.0) +
             ",0,0,0,0\n";
    }
    return csv;
  }
  std::string configuration() {
    const std::string file = path("settings.toml");
    auto settings = config::parse(
        "[port.compass]\nprotocol = \"tcm2\"\npath = \"/dev/a\"\n[port.imu]\nprotocol = \"imu-card\"\npath = "
        "\"/dev/b\"\n"
        "[port.gps]\nprotocol = \"oncore\"\npath = \"/dev/c\"\n[port.motor]\nprotocol = \"motor-card\"\npath = "
        "\"/dev/d\"\n"
        "[instruments]\ncompass_field_noise_uT = 0.4\ncompass_tilt_noise_deg = 0.25\ncompass_temperature_noise_C "
        "= 0.3\n"
        "imu_gyro_noise_deg_s = 0.03\nimu_force_noise_m_s2 = 0.05\nimu_depth_noise_m = 0.07\n"
        "gps_position_noise_m = 2.5\ngps_velocity_noise_m_s = 0.06\nmotor_fin_noise_deg = 0.3\n"
        "motor_current_noise_A = 0.05\n",
        "test");
    std::ofstream(file) << config::to_toml(settings);
    return file;
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(NoiseCommand, FindsTheConfiguredNoiseOfEachChannel) {
  const std::map<std::string, double> configured{
      {"field_x", 0.4},     {"field_y", 0.4},         {"field_z", 0.4},        {"pitch", 0.25},
      {"roll", 0.25},       {"rate_x", 0.03},         {"rate_y", 0.03},        {"rate_z", 0.03},
      {"yaw_rate_b", 0.03}, {"temperature", 0.3},     {"force_x", 0.05},       {"force_y", 0.05},
      {"force_z", 0.05},    {"depth", 0.07},          {"north", 2.5},          {"east", 2.5},
      {"fin_1", 0.3},       {"velocity_north", 0.06}, {"velocity_east", 0.06}, {"current", 0.05}};
  const auto config = configuration();
  const auto capture = simulated(still(), 600, {"--config", config});
  const auto json = answer({capture, "--config", config, "--write", path("found.toml")});
  ASSERT_EQ(json["quiet"].size(), 1U);
  EXPECT_GT(json["quiet"][0]["to_s"], 590);
  std::size_t compared = 0;
  for (const auto& channel : json["channels"]) {
    const auto known = configured.find(channel["channel"]);
    if (known == configured.end()) continue;
    ++compared;
    ASSERT_FALSE(channel["unrounded_std"].is_null()) << channel["channel"];
    const double std = channel["unrounded_std"], error = channel["unrounded_std_error"];
    EXPECT_NEAR(std, known->second, 4 * error) << channel["channel"];
    EXPECT_LT(error, 0.05 * known->second) << channel["channel"];
    EXPECT_EQ(channel["correlated"], false) << channel["channel"];
    EXPECT_TRUE(channel["lines"].empty()) << channel["channel"];
    EXPECT_TRUE(channel["bias_instability"].is_null()) << channel["channel"];
  }
  EXPECT_EQ(compared, configured.size());

  const auto found = config::load(path("found.toml"));
  const auto wanted = config::load(config);
  EXPECT_NEAR(found.instruments.compass.field_noise_uT, 0.4, 0.02);
  EXPECT_NEAR(found.instruments.imu.gyro_noise_rad_s / wanted.instruments.imu.gyro_noise_rad_s, 1, 0.03);
  EXPECT_NEAR(found.instruments.gps.position_noise_m, 2.5, 0.25);
  EXPECT_EQ(found.ports, wanted.ports);
  // What reads configurations takes it: a simulation with the instruments that were found.
  simulated(still(), 5, {"--config", path("found.toml")});
}

TEST_F(NoiseCommand, MotionInTheMiddleIsLeftOut) {
  const auto capture = simulated(swinging(60, 100, 160), 160);
  const auto json = answer({capture});
  ASSERT_EQ(json["quiet"].size(), 2U);
  EXPECT_LE(json["quiet"][0]["to_s"], 61);
  EXPECT_GE(json["quiet"][0]["to_s"], 55);
  EXPECT_GE(json["quiet"][1]["from_s"], 99);
  EXPECT_LE(json["quiet"][1]["from_s"], 106);
  for (const auto& channel : json["channels"]) {
    if (channel["channel"] == "rate_z") {
      EXPECT_NEAR(channel["std"], 0.1, 0.01);
      EXPECT_EQ(channel["stretches"], 2);
    }
  }
}

TEST_F(NoiseCommand, AVehicleThatMovesAllTheTimeIsToldWithTheNumber) {
  const auto capture = simulated(swinging(0, 90, 90), 85);
  const auto json = answer({capture});
  EXPECT_TRUE(json["quiet"].empty());
  const std::string reason = json["reason"];
  EXPECT_NE(reason.find("no part is at rest: even in the quietest 8 s"), std::string::npos) << reason;
  const auto written = noise({capture, "--write", path("none.toml")});
  EXPECT_EQ(written.status, 1);
  EXPECT_FALSE(std::filesystem::exists(path("none.toml")));
  // The user knows better.
  const auto chosen = answer({capture, "--from", "10", "--to", "50"});
  EXPECT_EQ(chosen["chosen"], true);
  EXPECT_EQ(chosen["quiet"][0]["from_s"], 10);
  EXPECT_EQ(chosen["quiet"][0]["to_s"], 50);
  EXPECT_GT(chosen["channels"][0]["readings"], 100);
}

TEST_F(NoiseCommand, APartOutsideTheRecordingIsWrongUsage) {
  const auto capture = simulated(still(), 20);
  for (const auto& part : std::vector<std::vector<std::string>>{
           {"--from", "30"}, {"--to", "0"}, {"--from", "5", "--to", "5"}, {"--from", "-1"}, {"--from", "nan"}}) {
    std::vector<std::string> arguments{capture};
    arguments.insert(arguments.end(), part.begin(), part.end());
    EXPECT_EQ(noise(arguments).status, 2) << part[0] << part[1];
  }
}

TEST_F(NoiseCommand, AnExistingFileIsNotOverwritten) {
  const auto capture = simulated(still(), 20);
  const auto file = write("mine.toml", "# mine\n");
  const auto outcome = noise({capture, "--write", file});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.message.find(file), std::string::npos);
  EXPECT_EQ(navcal::test::read_file(file), "# mine\n");
  EXPECT_EQ(outcome.output, "");
}

TEST_F(NoiseCommand, TheReportIsWritten) {
  const auto capture = simulated(still(), 30);
  EXPECT_EQ(noise({capture, "--report", path("page.html")}).status, 0);
  EXPECT_NE(navcal::test::read_file(path("page.html")).find("Allan deviation"), std::string::npos);
}

TEST_F(NoiseCommand, BadInputIsTold) {
  EXPECT_EQ(noise({path("missing.cap")}).status, 3);
  EXPECT_EQ(noise({write("empty.cap", "")}).status, 3);
  EXPECT_EQ(noise({write("text.cap", "hello\n")}).status, 3);
}

TEST_F(NoiseCommand, AFewSamplesAndNumbersThatAreNoneAreTakenAsTheyAre) {
  std::string capture = "#capture 1\n#port compass nmea 4800\n";
  const auto add = [&](int second, const std::string& content) {
    unsigned sum = 0;
    for (const char c : content) sum ^= static_cast<unsigned char>(c);
    constexpr const char* kUpper = "0123456789ABCDEF";
    const std::string sentence = "$" + content + "*" + kUpper[sum / 16] + kUpper[sum % 16] + "\r\n";
    capture += "19000000" + std::to_string(10 + second) + ".000000000 compass < ";
    for (const char c : sentence) {
      constexpr const char* kDigits = "0123456789abcdef";
      capture += kDigits[static_cast<unsigned char>(c) / 16];
      capture += kDigits[static_cast<unsigned char>(c) % 16];
    }
    capture += "\n";
  };
  add(0, "HCHDM,nan,M");
  add(1, "HCHDM,1e999,M");
  add(2, "HCHDM,12.5,M");
  add(3, "HCHDM,12.6,M");
  add(4, "HCHDM,12.5,M");
  const auto json = answer({write("three.cap", capture)});
  EXPECT_TRUE(json["quiet"].empty());
  const auto chosen = answer({path("three.cap"), "--from", "0"});
  ASSERT_EQ(chosen["channels"].size(), 1U);
  EXPECT_EQ(chosen["channels"][0]["readings"], 3);
  EXPECT_TRUE(chosen["channels"][0]["std"].is_null());
  EXPECT_NEAR(chosen["channels"][0]["resolution"], 0.1, 1e-9);
}

TEST_F(NoiseCommand, ALogThatIsCutIsUsedAsFarAsItGoes) {
  const auto capture = simulated(still(), 60);
  ASSERT_EQ(test::run_command(test::add_log_of_files, {"log", "import", "-o", path("whole.mcap"), capture}).status,
            0);
  const auto whole = navcal::test::read_file(path("whole.mcap"));
  const auto json = answer({write("cut.mcap", whole.substr(0, whole.size() * 6 / 10))});
  EXPECT_GT(json["duration_s"], 20);
  EXPECT_LT(json["duration_s"], 50);
  EXPECT_EQ(json["quiet"].size(), 1U);
}

/// A real board that lay still until 44 s and from 140 s on, by optical motion capture (../shared/data/ORIGIN.md).
TEST_F(NoiseCommand, ARealBoardIsAtRestWhereMotionCaptureSaysSo) {
  const std::string capture = NAVCAL_SHARED_DIR "/data/broad34.cap";
  if (!std::filesystem::exists(capture)) GTEST_SKIP() << "there is no " << capture;
  const auto json = answer({capture});
  ASSERT_EQ(json["quiet"].size(), 2U);
  EXPECT_EQ(json["quiet"][0]["from_s"], 0);
  EXPECT_GT(json["quiet"][0]["to_s"], 40);
  EXPECT_LE(json["quiet"][0]["to_s"], 45);
  EXPECT_GE(json["quiet"][1]["from_s"], 138);
  EXPECT_LT(json["quiet"][1]["from_s"], 145);
  EXPECT_GT(json["quiet"][1]["to_s"], 168);
}

}  // namespace
}  // namespace navcal::cli
