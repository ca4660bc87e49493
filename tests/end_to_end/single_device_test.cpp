// SPDX-License-Identifier: Apache-2.0
// One emulated device of today and navcald, live: the start-up dialogue over a pseudo-terminal, and what the log
// then holds.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/process.h"

namespace navcal {
namespace {

constexpr std::chrono::seconds kSinglePatience{60};

struct SingleDevice {
  const char* protocol;
  const char* configured;  ///< what the start-up dialogue says at its end
};

class EndToEndDevice : public testing::TestWithParam<SingleDevice> {
 protected:
  [[nodiscard]] std::string log() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "logs")) {
      if (entry.path().extension() == ".mcap") return entry.path().string();
    }
    return {};
  }
  /// Samples of a class that the log holds so far, each with a time that has an error.
  [[nodiscard]] int samples(const std::string& name) const {
    test::Process replay({NAVCAL_PROGRAM, "replay", log()}, folder_ / "replay");
    if (replay.wait(kSinglePatience) != 0) return 0;
    std::istringstream lines(replay.out());
    int count = 0;
    for (std::string line; std::getline(lines, line);) {
      const auto sample = nlohmann::json::parse(line);
      if (sample["class"] == name && sample["device"] == "sensor" && sample["time_std"] > 0) ++count;
    }
    return count;
  }
  test::TemporaryFolder folder_;
};

TEST_P(EndToEndDevice, IsConfiguredAndRecorded) {
  const std::string ports = (folder_ / "ports").string();
  std::filesystem::create_directories(folder_ / "logs");
  std::ofstream(folder_ / "navcald.toml")
      << "[port.sensor]\nprotocol = \"" << GetParam().protocol << "\"\npath = \"" << ports << "/sensor\"\n";
  test::Process emulator(
      {NAVCAL_PROGRAM, "emulate", "--dir", ports, "--device", std::string("sensor=") + GetParam().protocol},
      folder_ / "emulate");
  const auto is_ready = [&] { return emulator.out().find("ready") != std::string::npos; };
  ASSERT_TRUE(test::eventually(is_ready, kSinglePatience)) << emulator.err();
  test::Process daemon({NAVCALD, "--config", (folder_ / "navcald.toml").string(), "--set",
                        "log.directory=" + (folder_ / "logs").string(), "--set", "status.port=0", "--set",
                        "control.socket=" + (folder_ / "control").string()},
                       folder_ / "navcald");
  const auto is_configured = [&] { return daemon.err().find(GetParam().configured) != std::string::npos; };
  EXPECT_TRUE(test::eventually(is_configured, kSinglePatience)) << daemon.err();
  for (const std::string name : {"COMPASS", "IMU"}) {
    int tries = 0;
    while (samples(name) < 10 && ++tries < 60) std::this_thread::sleep_for(std::chrono::seconds(1));
    EXPECT_LT(tries, 60) << name;
  }
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(kSinglePatience), 0) << daemon.err();
  emulator.signal(SIGTERM);
  EXPECT_EQ(emulator.wait(kSinglePatience), 0) << emulator.err();
}

INSTANTIATE_TEST_SUITE_P(OfToday, EndToEndDevice,
                         testing::Values(SingleDevice{"mip", "running on D5 04 05 06 0C, filter D5 05 0A 10"},
                                         SingleDevice{"pni", "running"}),
                         [](const auto& device) { return std::string(device.param.protocol); });

}  // namespace
}  // namespace navcal
