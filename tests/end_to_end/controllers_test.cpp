// SPDX-License-Identifier: Apache-2.0
// The emulated vehicle, navcald, and the controllers of docs/examples, live: orders go to the card and back, and
// stand in log, replay and export.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/daemon/tcp_client.h"
#include "tests/support/free_port.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

using test::eventually;
using test::free_port;
using test::Process;
using test::TemporaryFolder;
using Json = nlohmann::json;

constexpr std::chrono::seconds kControllerPatience{90};

/// The emulated instruments and their navcald.
class ControlledVehicle : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream config(folder_ / "navcald.toml");
    for (const auto& [port, protocol] : {std::pair{"compass", "tcm2"}, std::pair{"imu", "imu-card"},
                                         std::pair{"gps", "oncore"}, std::pair{"motor", "motor-card"}}) {
      config << "[port." << port << "]\nprotocol = \"" << protocol << "\"\npath = \""
             << (folder_ / "ports" / port).string() << "\"\n";
      if (std::string_view(port) == "compass") config << "baud = 38400\n";
    }
    config.close();
    emulator_ = std::make_unique<Process>(
        std::vector<std::string>{NAVCAL_PROGRAM, "emulate", "--dir", (folder_ / "ports").string(), "--seed", "5"},
        folder_ / "emulate");
    ASSERT_TRUE(
        eventually([&] { return emulator_->out().find("ready") != std::string::npos; }, kControllerPatience))
        << emulator_->err();
    status_port_ = free_port();
    daemon_ = std::make_unique<Process>(
        std::vector<std::string>{
            NAVCALD, "--config", (folder_ / "navcald.toml").string(), "--set",
            "log.directory=" + (folder_ / "logs").string(), "--set", "status.port=" + std::to_string(status_port_),
            "--set", "control.socket=" + (folder_ / "control").string(), "--set", "log.free_floor_MB=0"},
        folder_ / "navcald");
    ASSERT_TRUE(eventually([&] { return !state("1").is_null(); }, kControllerPatience)) << daemon_->err();
  }
  /// A STATE that has the motor's and the compass's measurements; null while there is none.
  [[nodiscard]] Json state(const std::string& rate_Hz) const {
    try {
      daemon::Client client(status_port_);
      client.send(R"(?WATCH={"enable":true,"json":true,"classes":["STATE"],"rate_Hz":{"STATE":)" + rate_Hz +
                  "}};\n");
      const Json found = Json::parse(client.line_with("\"STATE\",\"time\""));
      return found["shaft_rpm"].is_null() || found["heading_rad"].is_null() ? Json() : found;
    } catch (const std::runtime_error&) {
      return {};
    }
  }
  /// Runs a controller for some seconds, and what it says.
  std::string run(std::vector<std::string> command) {
    Process controller(command, folder_ / "controller");
    EXPECT_EQ(controller.wait(kControllerPatience), 0) << controller.err();
    return controller.out();
  }
  std::string run_python(double seconds, double rpm) {
    return run({"python3", NAVCAL_SOURCE_DIR "/docs/examples/controller.py", "--control",
                (folder_ / "control").string(), "--status", std::to_string(status_port_), "--heading", "90",
                "--rpm", std::to_string(rpm), "--seconds", std::to_string(seconds)});
  }
  std::string run_cpp(double seconds, double rpm) {
    return run({CONTROLLER, (folder_ / "control").string(), std::to_string(status_port_), "90",
                std::to_string(rpm), std::to_string(seconds)});
  }
  /// Ends the daemon; COMMAND lines of the replay of its log.
  std::vector<Json> replayed_commands() {
    daemon_->signal(SIGTERM);
    EXPECT_EQ(daemon_->wait(kControllerPatience), 0) << daemon_->err();
    std::vector<Json> commands;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "logs")) {
      if (entry.path().extension() != ".mcap") continue;
      log_ = entry.path();
      Process replay({NAVCAL_PROGRAM, "replay", log_.string()}, folder_ / "replay");
      EXPECT_EQ(replay.wait(kControllerPatience), 0) << replay.err();
      std::istringstream lines(replay.out());
      for (std::string line; std::getline(lines, line);) {
        if (line.find("\"class\":\"COMMAND\"") != std::string::npos) commands.push_back(Json::parse(line));
      }
    }
    return commands;
  }

  TemporaryFolder folder_;
  std::uint16_t status_port_ = 0;
  std::unique_ptr<Process> emulator_, daemon_;
  std::filesystem::path log_;
};

TEST_F(ControlledVehicle, BothExamplesDriveItAndLeaveItStanding) {
  EXPECT_NE(run_python(3, 300).find(" orders, the latest "), std::string::npos);
  EXPECT_NE(run_cpp(3, 450).find(" orders, the latest "), std::string::npos);
  EXPECT_TRUE(eventually([&] {
    const Json now = state("10");
    return now.is_object() && now["shaft_rpm"] == 0 && now["motor"]["holder"].is_null();
  }));
  const auto commands = replayed_commands();
  int python = 0, cpp = 0, echoed = 0;
  for (const Json& command : commands) {
    if (command["outcome"] == "echoed") ++echoed;
    if (command["source"] != "order") continue;
    EXPECT_GE(command["late_s"].get<double>(), 0);
    EXPECT_LT(command["asked"], command["sent"]);
    if (command["holder"] == "example-py" && command["shaft_sent_rpm"] == 300) ++python;
    if (command["holder"] == "example-cpp" && command["shaft_sent_rpm"] == 450) ++cpp;
  }
  EXPECT_GT(python, 0);
  EXPECT_GT(cpp, 0);
  EXPECT_GT(echoed, 0);
  ASSERT_FALSE(commands.empty());
  EXPECT_EQ(commands.back()["source"], "safe");
  EXPECT_EQ(commands.back()["outcome"], "echoed");

  Process exported({NAVCAL_PROGRAM, "log", "export", "--csv", (folder_ / "csv").string(), log_.string()},
                   folder_ / "export");
  ASSERT_EQ(exported.wait(kControllerPatience), 0) << exported.err();
  std::ifstream table(folder_ / "csv" / "command.csv");
  std::string line;
  std::size_t rows = 0;
  while (std::getline(table, line)) ++rows;
  EXPECT_EQ(rows, commands.size() + 1);
}

TEST_F(ControlledVehicle, AControllerThatIsKilledLeavesItStanding) {
  {
    Process controller(
        {CONTROLLER, (folder_ / "control").string(), std::to_string(status_port_), "90", "500", "60"},
        folder_ / "controller");
    EXPECT_TRUE(eventually([&] {
      const Json now = state("10");
      // The vehicle does as it likes, at 780 rpm, until it is told.
      return now.is_object() && now["motor"]["holder"] == "example-cpp" && now["order"]["sequence"] > 0 &&
             std::abs(now["shaft_rpm"].get<double>() - 500) < 20;
    }));
    controller.signal(SIGKILL);
    EXPECT_EQ(controller.wait(kControllerPatience), 128 + SIGKILL);
  }
  EXPECT_TRUE(eventually([&] {
    const Json now = state("10");
    return now.is_object() && now["shaft_rpm"] == 0 && now["motor"]["holder"].is_null();
  }));
}

TEST_F(ControlledVehicle, StateOfWordsComesWithTheCompass) {
  daemon::Client client(status_port_);
  client.send("?WATCH={\"enable\":true,\"json\":true,\"classes\":[\"STATE\",\"ATT\"],\"device\":\"compass\"};\n");
  client.line_with("\"WATCH\"");
  int states = 0, words = 0;
  for (int i = 0; i < 40; ++i) {
    const Json report = Json::parse(client.line().value());
    if (report["class"] == "ATT") ++words;
    if (report["class"] != "STATE") continue;
    ++states;
    EXPECT_LT(report["age_s"]["compass"].get<double>(), 5);
    EXPECT_TRUE(report["rate_rad_s"].is_array());
    EXPECT_TRUE(report["std"]["heading_rad"].is_number());
  }
  EXPECT_NEAR(states, words, 1);
}

}  // namespace
}  // namespace navcal
