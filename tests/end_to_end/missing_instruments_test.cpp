// SPDX-License-Identifier: Apache-2.0
// Emulated instruments and navcald, live, without one or two of the four: what the others give is reported, and
// the replay of the log gives the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "record/log/log_reader.h"
#include "record/recording.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

using test::eventually;
using test::Process;
using test::TemporaryFolder;
using Json = nlohmann::json;

constexpr std::chrono::seconds kMissingPatience{90};
struct Instrument {
  const char* port;
  const char* protocol;
};
constexpr std::array<Instrument, 4> kInstruments{
    {{"compass", "tcm2"}, {"imu", "imu-card"}, {"gps", "oncore"}, {"motor", "motor-card"}}};

/// The emulated instruments of one vehicle, and its navcald, which knows of some of them only.
class Vehicle {
 public:
  explicit Vehicle(std::vector<std::string> missing) : missing_(std::move(missing)) {
    std::filesystem::create_directories(folder_ / "logs");
    std::ofstream config(folder_ / "navcald.toml");
    for (const auto& [port, protocol] : kInstruments) {
      if (is_missing(port)) continue;
      config << "[port." << port << "]\nprotocol = \"" << protocol << "\"\npath = \""
             << (folder_ / "ports" / port).string() << "\"\n";
      if (std::string_view(port) == "compass") config << "baud = 38400\n";
    }
    config.close();
    emulator_ = std::make_unique<Process>(
        std::vector<std::string>{NAVCAL_PROGRAM, "emulate", "--dir", (folder_ / "ports").string(), "--seed", "5"},
        folder_ / "emulate");
  }
  void start_daemon() {
    std::vector<std::string> command{NAVCALD, "--config", (folder_ / "navcald.toml").string()};
    const auto set = [&](const std::string& setting) { command.insert(command.end(), {"--set", setting}); };
    set("log.directory=" + (folder_ / "logs").string());
    set("status.port=0");
    set("control.socket=" + (folder_ / "control").string());
    daemon_ = std::make_unique<Process>(command, folder_ / "navcald");
  }
  [[nodiscard]] bool emulator_is_ready() const { return emulator_->out().find("ready") != std::string::npos; }
  [[nodiscard]] bool is_missing(const std::string& port) const {
    return std::find(missing_.begin(), missing_.end(), port) != missing_.end();
  }
  [[nodiscard]] std::string name() const {
    std::string name = "without";
    for (const auto& port : missing_) name += " " + port;
    return name;
  }
  /// Reports of the estimator so far, as they were logged live; without each one's checksum.
  [[nodiscard]] std::vector<std::string> navigation() const {
    std::vector<std::string> reports;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "logs")) {
      if (entry.path().extension() != ".mcap") continue;
      try {
        record::LogReader reader(record::open_file(entry.path()), entry.path().string());
        while (const auto message = reader.next()) {
          if (reader.channels().at(message->channel).topic == "/nav")
            reports.push_back(std::string(message->data.substr(0, message->data.rfind(",\"crc\":"))) + "}");
        }
      } catch (const record::BadRecording&) {
        return {};  // just made: its head is not written yet
      }
    }
    return reports;
  }
  /// Whether the newest report has what the instruments give, and nothing else.
  [[nodiscard]] bool reports_what_it_can() const {
    const auto reports = navigation();
    if (reports.empty()) return false;
    const Json newest = Json::parse(reports.back(), nullptr, false);
    return newest["heading_rad"].is_number() == !is_missing("compass") &&
           newest["roll_rad"].is_number() == (!is_missing("compass") || !is_missing("imu")) &&
           newest["depth_m"].is_number() == !is_missing("imu") &&
           newest["lat"].is_number() == !is_missing("gps") &&
           newest["speed_m_s"].is_number() == !is_missing("motor");
  }
  void stop() {
    daemon_->signal(SIGTERM);
    EXPECT_EQ(daemon_->wait(kMissingPatience), 0) << name() << daemon_->err();
    emulator_->signal(SIGTERM);
    EXPECT_EQ(emulator_->wait(kMissingPatience), 0) << name() << emulator_->err();
  }
  [[nodiscard]] std::vector<std::string> replayed_navigation() const {
    std::vector<std::string> reports;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "logs")) {
      if (entry.path().extension() != ".mcap") continue;
      Process replay({NAVCAL_PROGRAM, "replay", entry.path().string()}, folder_ / "replay");
      EXPECT_EQ(replay.wait(kMissingPatience), 0) << name() << replay.err();
      std::istringstream lines(replay.out());
      for (std::string line; std::getline(lines, line);) {
        if (line.find("\"class\":\"NAV\"") != std::string::npos) reports.push_back(line);
      }
    }
    return reports;
  }
  [[nodiscard]] std::string said() const { return daemon_->err(); }

 private:
  TemporaryFolder folder_;
  std::vector<std::string> missing_;
  std::unique_ptr<Process> emulator_, daemon_;
};

// All of them side by side: a receiver searches the sky for some ten seconds.
TEST(MissingInstruments, EachAndEachPairLive) {
  std::vector<std::unique_ptr<Vehicle>> vehicles;
  for (std::size_t i = 0; i < kInstruments.size(); ++i) {
    vehicles.push_back(std::make_unique<Vehicle>(std::vector<std::string>{kInstruments.at(i).port}));
    for (std::size_t j = i + 1; j < kInstruments.size(); ++j) {
      vehicles.push_back(
          std::make_unique<Vehicle>(std::vector<std::string>{kInstruments.at(i).port, kInstruments.at(j).port}));
    }
  }
  for (auto& vehicle : vehicles) {
    ASSERT_TRUE(eventually([&] { return vehicle->emulator_is_ready(); }, kMissingPatience)) << vehicle->name();
    vehicle->start_daemon();
  }
  for (auto& vehicle : vehicles) {
    EXPECT_TRUE(eventually([&] { return vehicle->reports_what_it_can(); }, kMissingPatience))
        << vehicle->name() << '\n'
        << vehicle->said() << (vehicle->navigation().empty() ? "no report" : vehicle->navigation().back());
  }
  for (auto& vehicle : vehicles) vehicle->stop();
  for (auto& vehicle : vehicles) {
    const auto live = vehicle->navigation();
    EXPECT_FALSE(live.empty()) << vehicle->name();
    EXPECT_EQ(live, vehicle->replayed_navigation()) << vehicle->name();
  }
}

}  // namespace
}  // namespace navcal
