// SPDX-License-Identifier: Apache-2.0
// Emulated Doppler logs and pressure gauges at pseudo-terminals, navcald with their start-up dialogues, and the
// replay of its log.
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

constexpr std::chrono::seconds kDopplerPatience{90};
/// Port and protocol of each device.
constexpr std::pair<const char*, const char*> kDevices[] = {{"waterlinked", "waterlinked"},
                                                            {"pd0", "pd0"},
                                                            {"pd6", "pd6"},
                                                            {"paro", "paroscientific"},
                                                            {"keller", "keller"}};

struct DopplerPorts : ::testing::Test {
  TemporaryFolder folder;
  std::unique_ptr<Process> emulator, daemon;

  [[nodiscard]] std::string at(const std::string& name) const { return (folder / name).string(); }

  void start() {
    std::vector<std::string> command{NAVCAL_PROGRAM, "emulate", "--dir",         at("ports"),
                                     "--seed",       "5",       "--floor-depth", "30"};
    std::ofstream config(folder / "navcald.toml");
    config << "[log]\ndirectory = \"" << at("logs")
           << "\"\nfree_floor_MB = 0\n[status]\nport = 0\n[control]\nsocket = \"" << at("control") << "\"\n";
    for (const auto& [port, protocol] : kDevices) {
      command.emplace_back("--device");
      command.push_back(std::string(port) + "=" + protocol);
      config << "[port." << port << "]\nprotocol = \"" << protocol << "\"\npath = \"" << at("ports") << "/" << port
             << "\"\n";
    }
    config.close();
    emulator = std::make_unique<Process>(command, folder / "emulate");
    ASSERT_TRUE(eventually([&] { return emulator->out().find("ready") != std::string::npos; }, kDopplerPatience));
    daemon = std::make_unique<Process>(std::vector<std::string>{NAVCALD, "--config", at("navcald.toml")},
                                       folder / "navcald");
  }
  [[nodiscard]] std::string log() const {
    if (!std::filesystem::exists(folder / "logs")) return {};
    std::set<std::string> logs;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "logs")) {
      if (entry.path().extension() == ".mcap") logs.insert(entry.path().string());
    }
    return logs.empty() ? std::string() : *logs.begin();
  }
  /// What `navcal` answers to the words.
  std::string navcal(std::vector<std::string> words) const {
    words.insert(words.begin(), NAVCAL_PROGRAM);
    Process process(words, folder / "navcal");
    process.wait(kDopplerPatience);
    return process.out();
  }
  [[nodiscard]] std::vector<nlohmann::json> replayed() const {
    std::vector<nlohmann::json> lines;
    if (log().empty()) return lines;
    std::istringstream in(navcal({"replay", "--json", log()}));
    for (std::string line; std::getline(in, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }
  void stop(Process& process, const char* name) {
    process.signal(SIGTERM);
    EXPECT_EQ(process.wait(kDopplerPatience), 0) << name << process.err();
  }
};

std::size_t count_of(const std::vector<nlohmann::json>& lines, const std::string& device, const std::string& key) {
  return static_cast<std::size_t>(std::count_if(lines.begin(), lines.end(), [&](const auto& line) {
    return line.value("device", "") == device && line.contains(key) && !line[key].is_null();
  }));
}

TEST_F(DopplerPorts, DevicesAreSetUpLoggedAndReplayed) {
  start();
  ASSERT_TRUE(eventually(
      [&] {
        const auto lines = replayed();
        return count_of(lines, "waterlinked", "bottom_velocity_m_s") > 10 &&
               count_of(lines, "pd0", "bottom_velocity_m_s") > 10 &&
               count_of(lines, "pd6", "bottom_velocity_m_s") > 10 && count_of(lines, "paro", "pressure_Pa") > 3 &&
               count_of(lines, "keller", "pressure_Pa") > 10;
      },
      kDopplerPatience))
      << daemon->err();
  for (const auto& line : replayed()) {
    if (line.value("class", "") == "DVL" && line.contains("altitude_m") && !line["altitude_m"].is_null()) {
      EXPECT_LT(line["altitude_m"], 32) << line;
      EXPECT_GT(line["altitude_m"], 1) << line;
    }
    if (line.value("class", "") == "DEPTH") {
      EXPECT_GT(line["pressure_Pa"], 99e3) << line;
      EXPECT_LT(line["pressure_Pa"], 400e3) << line;
    }
  }
  stop(*daemon, "navcald ");
  stop(*emulator, "emulate ");

  navcal({"log", "export", "--cap", at("all.cap"), log()});
  const std::string capture = test::read_file(folder / "all.cap");
  EXPECT_NE(capture.find(" keller > fa300443"), std::string::npos) << "the initialisation is in the log";
  EXPECT_NE(capture.find(" keller > fa4901a1a7"), std::string::npos) << "so are the requests";
  EXPECT_NE(capture.find(" paro > 2a30313030554e0d0a"), std::string::npos);
  EXPECT_NE(capture.find(" paro > 2a3031303050340d0a"), std::string::npos);
  for (const char* log_name : {"waterlinked", "pd0", "pd6"})
    EXPECT_EQ(capture.find(std::string(" ") + log_name + " > "), std::string::npos) << "nothing is sent to it";
}

}  // namespace
}  // namespace navcal
