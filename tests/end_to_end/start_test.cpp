// SPDX-License-Identifier: Apache-2.0
// `navcal start` for each kind of owner, on emulated sources: what arrives, what does not, and what it leaves
// behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "tests/daemon/daemon_process.h"
#include "tests/daemon/talking_line.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

using daemon::Client;
using daemon::FakeLine;
using daemon::TalkingLine;
using test::eventually;
using test::Process;

constexpr std::chrono::seconds kLimit{120};
constexpr const char* kRunning = "navcald runs until Ctrl-C";

/// A start in a folder of its own, with a status port of its own.
class Started {
 public:
  Started(const std::string& kind, std::vector<std::string> more, std::uint16_t port = test::free_port(),
          const std::string& output = {})
      : port_(port) {
    std::vector<std::string> command{
        NAVCAL_PROGRAM,      "start", "--for", kind, "--output", output.empty() ? file() : output, "--port",
        std::to_string(port)};
    if (std::ranges::count(more, "--seconds") == 0) more.insert(more.end(), {"--seconds", "6"});
    command.insert(command.end(), more.begin(), more.end());
    process_.emplace(command, folder_ / "start");
  }
  [[nodiscard]] std::string file() const { return (folder_ / "new/navcald.toml").string(); }
  [[nodiscard]] std::string out() const { return process_->out(); }
  [[nodiscard]] std::string said() const { return out() + "\n" + process_->err(); }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] bool runs() const {
    return eventually([&] { return out().find(kRunning) != std::string::npos; }, kLimit);
  }
  [[nodiscard]] bool says(const std::string& words) const { return said().find(words) != std::string::npos; }
  /// Samples of a kind a second, as it says them; 0: none.
  [[nodiscard]] double rate_of(const std::string& kind) const {
    std::smatch found;
    const std::string text = out();
    const std::regex words("  " + kind + " +([0-9.]+) a second, times known to [0-9.]+ ms, -?[0-9.]+ ms old");
    return std::regex_search(text, found, words) ? std::stod(found[1]) : 0;
  }
  std::optional<int> wait() { return process_->wait(kLimit); }
  void stop() {
    process_->signal(SIGINT);
    EXPECT_EQ(wait(), 0) << said();
    EXPECT_TRUE(says("navcald has stopped in good order")) << said();
  }
  /// Ctrl-C: the daemon stops, its log is whole, and nobody holds its sockets any more.
  void interrupt() {
    stop();
    EXPECT_THROW(Client{port_}, std::runtime_error);
    int logs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "new/log")) {
      if (entry.path().extension() != ".mcap") continue;
      ++logs;
      Process info({NAVCAL_PROGRAM, "log", "info", entry.path()}, folder_ / "info");
      EXPECT_EQ(info.wait(kLimit), 0);
      EXPECT_NE(info.out().find("finished"), std::string::npos) << info.out();
    }
    EXPECT_EQ(logs, 1);
  }

 private:
  test::TemporaryFolder folder_;
  std::uint16_t port_;
  std::optional<Process> process_;
};

TEST(Start, ABlueRov2IsListenedTo) {
  const std::string place = std::to_string(test::free_port());
  Started start("bluerov2", {"--address", "udp:127.0.0.1:" + place});
  const test::TemporaryFolder folder;
  const Process autopilot({"node", NAVCAL_SOURCE_DIR "/tests/end_to_end/mavlink/autopilot.mjs", place, "600",
                           (folder / "truth.json").string()},
                          folder / "autopilot");
  ASSERT_TRUE(start.runs()) << start.said();
  EXPECT_TRUE(start.says("port rov: mavlink at 4000000 Bd, udp:127.0.0.1:" + place)) << "the words of --check";
  EXPECT_TRUE(start.says("port rov: running")) << start.said();
  EXPECT_NEAR(start.rate_of("IMU"), 50, 10) << start.said();
  EXPECT_NEAR(start.rate_of("DEPTH"), 10, 2) << start.said();
  EXPECT_GT(start.rate_of("COMPASS"), 0) << start.said();
  EXPECT_TRUE(start.says("heading (the autopilot's own until a calibration is in force)")) << start.said();
  EXPECT_FALSE(start.says("arrives. ")) << start.said();
  std::smatch page;
  const std::string said = start.said();
  ASSERT_TRUE(std::regex_search(said, page, std::regex("page: http://127.0.0.1:([0-9]+)/"))) << said;
  EXPECT_TRUE(eventually([&] {
    try {
      Client browser(static_cast<std::uint16_t>(std::stoi(page[1])));
      browser.send("GET / HTTP/1.1\r\nHost: 127.0.0.1:" + page[1].str() + "\r\n\r\n");
      return browser.line()->starts_with("HTTP/1.1 200");
    } catch (const std::runtime_error&) {
      return false;
    }
  })) << start.said();
  start.interrupt();
}

TEST(Start, WhatDoesNotArriveIsSaidWithWhatToDo) {
  Started start("bluerov2", {"--address", "udp:127.0.0.1:" + std::to_string(test::free_port())});
  ASSERT_TRUE(start.runs()) << start.said();
  EXPECT_TRUE(start.says("port rov: silent")) << start.said();
  EXPECT_TRUE(start.says("No measurement arrives. In BlueOS, MAVLink Endpoints, add a UDP client"))
      << start.said();
  start.interrupt();
}

TEST(Start, AReceiverForGpsdsClients) {
  const FakeLine line;
  std::optional<TalkingLine> talking(std::in_place, line);
  Started start("gpsd", {"--device", line.path()});
  ASSERT_TRUE(start.runs()) << start.said();
  EXPECT_TRUE(start.says("port gps: nmea at 9600 Bd")) << start.said();
  EXPECT_GT(start.rate_of("GPS"), 5) << start.said();
  EXPECT_FALSE(start.says("arrives. ")) << start.said();
  Client cgps(start.port());
  cgps.send("?WATCH={\"enable\":true,\"json\":true};\n");
  const auto fix = nlohmann::json::parse(cgps.line_with("\"class\":\"TPV\""));
  EXPECT_NEAR(fix["lat"], 57.71283, 1e-4);

  // Another start for the same receiver, and one for the same status port.
  Started second("gpsd", {"--device", line.path()});
  EXPECT_EQ(second.wait(), 1) << second.said();
  EXPECT_TRUE(second.says(line.path() + " is held by navcald")) << second.said();
  EXPECT_TRUE(second.says("nothing was started; the configuration is kept")) << second.said();
  const FakeLine other;
  Started third("gpsd", {"--device", other.path()}, start.port());
  EXPECT_EQ(third.wait(), 1) << third.said();
  EXPECT_TRUE(third.says("TCP port " + std::to_string(start.port()) + " is served by navcald")) << third.said();
  EXPECT_TRUE(third.says("--port N")) << third.said();
  talking.reset();  // while somebody reads the line
  start.interrupt();
}

TEST(Start, AReceiverWithoutAFixAndOneThatIsSilent) {
  const FakeLine line, silent;
  std::optional<TalkingLine> talking(std::in_place, line, TalkingLine::Fixes::none);
  Started start("gpsd", {"--device", line.path()}), nothing("gpsd", {"--device", silent.path()});
  ASSERT_TRUE(start.runs()) << start.said();
  EXPECT_TRUE(start.says("No position arrives. The receiver has no fix yet")) << start.said();
  ASSERT_TRUE(nothing.runs()) << nothing.said();
  EXPECT_TRUE(nothing.says("No measurement arrives. Has the receiver power")) << nothing.said();
  talking.reset();  // while somebody reads the line
  start.interrupt();
  nothing.interrupt();
}

TEST(Start, ADeviceWithNmea) {
  const FakeLine line;
  std::optional<TalkingLine> talking(std::in_place, line);
  Started start("nmea", {"--device", line.path()});
  ASSERT_TRUE(start.runs()) << start.said();
  EXPECT_NEAR(start.rate_of("COMPASS"), 10, 4) << start.said();
  EXPECT_GT(start.rate_of("GPS"), 0) << start.said();
  EXPECT_TRUE(std::regex_search(start.said(), std::regex("serves .*heading.*position"))) << start.said();
  talking.reset();  // while somebody reads the line
  start.interrupt();
}

TEST(Start, AFileThatIsThereStaysAsItIs) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "navcald.toml").string();
  std::ofstream(file) << "# mine\n";
  const FakeLine line;
  Started refused("nmea", {"--device", line.path()}, test::free_port(), file);
  EXPECT_EQ(refused.wait(), 1) << refused.said();
  EXPECT_TRUE(refused.says(file + ": the file is there with other content and is not written over"))
      << refused.said();
  EXPECT_EQ(test::read_file(file), "# mine\n");

  // What an earlier start wrote is used again.
  std::filesystem::remove(file);
  const std::uint16_t port = test::free_port();
  for (const char* const words : {"navcald.toml\n", "navcald.toml, of an earlier start\n"}) {
    Started start("nmea", {"--device", line.path()}, port, file);
    ASSERT_TRUE(eventually([&] { return start.says("listening for"); }, kLimit)) << start.said();
    EXPECT_TRUE(start.says(words)) << start.said();
    start.stop();
  }
}

TEST(Start, CtrlCWhileItListensEndsAllOfIt) {
  const FakeLine line;
  std::optional<TalkingLine> talking(std::in_place, line);
  Started start("nmea", {"--device", line.path(), "--seconds", "600"});
  ASSERT_TRUE(eventually(
      [&] {
        try {
          const Client client(start.port());
          return start.says("listening for");
        } catch (const std::runtime_error&) {
          return false;
        }
      },
      kLimit));
  talking.reset();  // while somebody reads the line
  start.interrupt();
  EXPECT_TRUE(line.is_closed());
}

TEST(Start, OptionsOfAnotherKindAreWrongUsage) {
  for (const auto& more :
       std::vector<std::vector<std::string>>{{"--address", "udp:127.0.0.1:1"}, {"--in", "imu=/a"}}) {
    Started start("gpsd", more);
    EXPECT_EQ(start.wait(), 2) << start.said();
  }
}

// navcal-ros2 of another navcald publishes the fixes that this one takes.
TEST(Start, NodesOfRos2) {
  const std::string ros2 = NAVCAL_BINARY_DIR "/ros2/navcal-ros2";
  if (!std::filesystem::exists(ros2)) GTEST_SKIP() << ros2 << " is not built here";
  ::setenv("CYCLONEDDS_URI", "file://" NAVCAL_SOURCE_DIR "/systemd/ros2-loopback.xml", 1);
  ::setenv("ROS_DOMAIN_ID", std::to_string(1 + ::getpid() % 99).c_str(), 1);
  const FakeLine line;
  std::optional<TalkingLine> talking(std::in_place, line);
  Started vehicle("nmea", {"--device", line.path()});
  ASSERT_TRUE(vehicle.runs()) << vehicle.said();
  const test::TemporaryFolder folder;
  const Process node({ros2, "--status", "127.0.0.1:" + std::to_string(vehicle.port())}, folder / "node");
  ASSERT_TRUE(eventually([&] { return node.out().find("domain") != std::string::npos; }, kLimit)) << node.err();
  Started start("ros2", {"--in", "fix=/navcal/nmea/fix"});
  ASSERT_TRUE(start.runs()) << start.said();
  EXPECT_GT(start.rate_of("GPS"), 0) << start.said();
  EXPECT_TRUE(start.says("serves position")) << start.said();
  start.interrupt();

  Started silent("ros2", {"--in", "imu=/nobody"});
  ASSERT_TRUE(silent.runs()) << silent.said();
  EXPECT_TRUE(silent.says("No measurement arrives. `ros2 topic hz TOPIC` says")) << silent.said();
  silent.interrupt();
  talking.reset();  // while somebody reads the line
  vehicle.interrupt();
}

}  // namespace
}  // namespace navcal
