// SPDX-License-Identifier: Apache-2.0
// navcal gap watch beside navcald on emulated instruments, live: it finds the field by the first fix, judges
// windows, and keeps its state when it is interrupted.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "tests/support/free_port.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

using test::eventually;
using test::Process;

constexpr std::chrono::seconds kWatchPatience{280};

class GapWatchLive : public testing::Test {
 protected:
  void SetUp() override {
    const std::string ports = (folder_ / "ports").string();
    emulator_ = start({NAVCAL_PROGRAM, "emulate", "--mission", "survey", "--dir", ports}, "emulate");
    ASSERT_TRUE(eventually([&] { return emulator_->out().find("ready") != std::string::npos; }, kWatchPatience))
        << emulator_->err();
    std::ofstream config(folder_ / "navcald.toml");
    config << "log.enabled = false\nstatus.port = " << port_ << "\ncontrol.socket = \""
           << (folder_ / "control").string() << "\"\n";
    for (const auto& [name, protocol] :
         {std::pair{"compass", "tcm2"}, {"imu", "imu-card"}, {"gps", "oncore"}, {"motor", "motor-card"}}) {
      config << "[port." << name << "]\nprotocol = \"" << protocol << "\"\npath = \"" << ports << '/' << name
             << "\"\n";
    }
    config.close();
    daemon_ = start({NAVCALD, "--config", (folder_ / "navcald.toml").string()}, "navcald");
  }
  [[nodiscard]] std::unique_ptr<Process> start(const std::vector<std::string>& command, const char* name) const {
    return std::make_unique<Process>(command, folder_ / name);
  }
  [[nodiscard]] std::unique_ptr<Process> watch(const char* name) const {
    return start(
        {NAVCAL_PROGRAM, "gap", "watch", "--port", std::to_string(port_), "--bank", "12", "--cache",
         (folder_ / "banks").string(), "--state", (folder_ / "state.json").string(), "--status-minutes", "0"},
        name);
  }
  /// The newest event of this kind that a watch has told.
  [[nodiscard]] static std::optional<nlohmann::json> event(const Process& watch, const std::string& kind) {
    std::optional<nlohmann::json> found;
    std::istringstream lines(watch.out());
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::json::parse(line, nullptr, false);
      if (json.is_object() && json.value("event", "") == kind) found = json;
    }
    return found;
  }

  test::TemporaryFolder folder_;
  std::uint16_t port_ = test::free_port();
  std::unique_ptr<Process> emulator_, daemon_;
};

TEST_F(GapWatchLive, JudgesWindowsAndGoesOnAfterAnInterrupt) {
  auto first = watch("first");
  ASSERT_TRUE(eventually([&] { return event(*first, "status").has_value(); }, kWatchPatience))
      << first->out() << first->err() << daemon_->err();
  EXPECT_TRUE(event(*first, "began"));
  first->signal(SIGINT);
  EXPECT_EQ(first->wait(kWatchPatience), 0) << first->err();
  const auto judged = event(*first, "status")->at("windows").get<int>();
  EXPECT_GE(judged, 1);

  const auto second = watch("second");
  ASSERT_TRUE(eventually([&] { return event(*second, "began").has_value(); }, kWatchPatience)) << second->err();
  EXPECT_EQ(event(*second, "began")->at("restored_windows"), judged);

  daemon_->signal(SIGTERM);
  EXPECT_EQ(daemon_->wait(kWatchPatience), 0) << daemon_->err();
  EXPECT_TRUE(eventually([&] { return event(*second, "disconnected").has_value(); }, kWatchPatience))
      << second->out();
}

}  // namespace
}  // namespace navcal
