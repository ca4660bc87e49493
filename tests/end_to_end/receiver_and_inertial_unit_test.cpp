// SPDX-License-Identifier: Apache-2.0
// A u-blox receiver and a VectorNav, both emulated as delivered: navcald sets them up over pseudo-terminals, and
// its log gives their samples when it is replayed.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/support/process.h"

namespace navcal {
namespace {

using test::eventually;
using test::Process;
using test::TemporaryFolder;

constexpr std::chrono::seconds kDevicePatience{90};

struct ReceiverAndInertialUnit : ::testing::Test {
  TemporaryFolder folder;
  std::unique_ptr<Process> emulator, daemon;

  [[nodiscard]] std::string at(const std::string& name) const { return (folder / name).string(); }

  void start() {
    emulator = std::make_unique<Process>(
        std::vector<std::string>{NAVCAL_PROGRAM, "emulate", "--dir", at("ports"), "--seed", "5", "--device",
                                 "gps=ubx", "--device", "imu=vectornav"},
        folder / "emulate");
    ASSERT_TRUE(eventually([&] { return emulator->out().find("ready") != std::string::npos; }, kDevicePatience));
    std::ofstream(folder / "navcald.toml")
        << "[log]\ndirectory = \"" << at("logs")
        << "\"\nfree_floor_MB = 0\n[status]\nport = 0\n[control]\nsocket = \"" << at("control")
        << "\"\n[port.gps]\nprotocol = \"ubx\"\npath = \"" << at("ports/gps")
        << "\"\n[port.imu]\nprotocol = \"vectornav\"\npath = \"" << at("ports/imu") << "\"\n";
    daemon = std::make_unique<Process>(std::vector<std::string>{NAVCALD, "--config", at("navcald.toml")},
                                       folder / "navcald");
  }
  /// Lines of `navcal replay --json` of everything logged so far.
  [[nodiscard]] std::vector<nlohmann::json> replayed() const {
    std::vector<nlohmann::json> lines;
    if (!std::filesystem::exists(folder / "logs")) return lines;
    std::set<std::filesystem::path> logs;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "logs")) {
      if (entry.path().extension() == ".mcap") logs.insert(entry.path());
    }
    for (const auto& log : logs) {
      Process replay({NAVCAL_PROGRAM, "replay", "--json", log.string()}, folder / "replay");
      replay.wait(kDevicePatience);
      std::istringstream text(replay.out());
      for (std::string line; std::getline(text, line);) {
        auto parsed = nlohmann::json::parse(line, nullptr, false);
        if (parsed.is_object()) lines.push_back(std::move(parsed));
      }
    }
    return lines;
  }
  static std::size_t count(const std::vector<nlohmann::json>& lines, const std::string& kind, const char* key) {
    return static_cast<std::size_t>(std::count_if(lines.begin(), lines.end(), [&](const nlohmann::json& line) {
      return line.value("class", "") == kind && line.contains(key) && !line[key].is_null();
    }));
  }
  void stop(Process& process, const char* name) {
    process.signal(SIGTERM);
    EXPECT_EQ(process.wait(kDevicePatience), 0) << name << process.err();
  }
};

TEST_F(ReceiverAndInertialUnit, AreSetUpLoggedAndReplayed) {
  start();
  std::vector<nlohmann::json> lines;
  ASSERT_TRUE(eventually(
      [&] {
        lines = replayed();
        return count(lines, "GPS", "lat") > 2 && count(lines, "IMU", "rate_rad_s") > 100 &&
               count(lines, "COMPASS", "heading_std_rad") > 40;
      },
      kDevicePatience))
      << daemon->err() << lines.size();
  // As delivered, the receiver sends NMEA and the unit lines.
  EXPECT_TRUE(eventually(
      [&] {
        return daemon->err().find("running on NAV-PVT") != std::string::npos &&
               daemon->err().find("running on binary messages") != std::string::npos;
      },
      kDevicePatience))
      << daemon->err();
  for (const auto& line : lines) {
    if (line.value("class", "") != "GPS" || !line.contains("lat") || line["lat"].is_null()) continue;
    EXPECT_GT(line.value("position_std_m", 0.0), 0) << line;
    EXPECT_GT(line.value("height_std_m", 0.0), 0) << line;
  }
  stop(*daemon, "navcald ");
  stop(*emulator, "emulate ");
}

}  // namespace
}  // namespace navcal
