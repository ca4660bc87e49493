// SPDX-License-Identifier: Apache-2.0
// navcald with a socket for injected samples, the example of docs/examples as the sender, and what becomes of the
// samples: log, replay, export.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/process.h"

namespace navcal {
namespace {

using test::eventually;
using test::Process;
using test::TemporaryFolder;

constexpr std::chrono::seconds kInjectionPatience{90};

struct Injection : ::testing::Test {
  TemporaryFolder folder;
  std::unique_ptr<Process> daemon;

  [[nodiscard]] std::string at(const std::string& name) const { return (folder / name).string(); }

  void SetUp() override {
    std::ofstream(folder / "navcald.toml")
        << "[log]\ndirectory = \"" << at("logs")
        << "\"\nfree_floor_MB = 0\n[status]\nport = 0\n[control]\nsocket = \"" << at("control")
        << "\"\n[port.ctd]\nprotocol = \"samples\"\naddress = \"unix-listen:" << at("samples") << "\"\n";
    daemon = std::make_unique<Process>(std::vector<std::string>{NAVCALD, "--config", at("navcald.toml")},
                                       folder / "navcald");
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(folder / "samples"); }, kInjectionPatience))
        << daemon->err();
  }
  /// Sends readings as the example does; false when it fails.
  [[nodiscard]] bool inject(const std::string& readings) const {
    std::ofstream(folder / "readings") << readings;
    const std::string command = "python3 '" NAVCAL_SOURCE_DIR "/docs/examples/inject_samples.py' --socket '" +
                                at("samples") + "' < '" + at("readings") + "'";
    return std::system(command.c_str()) == 0;
  }
  [[nodiscard]] std::string log() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder / "logs")) {
      if (entry.path().extension() == ".mcap") return entry.path().string();
    }
    return {};
  }
  /// SENSOR lines of the replay of the log.
  [[nodiscard]] std::vector<nlohmann::json> sensors() const {
    std::vector<nlohmann::json> found;
    if (!std::filesystem::exists(folder / "logs") || log().empty()) return found;
    Process replay({NAVCAL_PROGRAM, "replay", "--json", log()}, folder / "replay");
    replay.wait(kInjectionPatience);
    std::istringstream lines(replay.out());
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::json::parse(line, nullptr, false);
      if (json.is_object() && json.value("class", "") == "SENSOR") found.push_back(json);
    }
    return found;
  }
};

TEST_F(Injection, AMissionSensorIsLoggedReplayedAndExported) {
  ASSERT_TRUE(inject("oxygen umol/l 250.5\nnonsense\n"));
  ASSERT_TRUE(inject("conductivity S/m 3.25\n"));
  ASSERT_TRUE(eventually([&] { return sensors().size() == 2; }, kInjectionPatience)) << daemon->err();
  const auto found = sensors();
  EXPECT_EQ(found[0]["quantity"], "oxygen");
  EXPECT_EQ(found[0]["unit"], "umol/l");
  EXPECT_EQ(found[0]["value"], 250.5);
  EXPECT_EQ(found[0]["device"], "ctd");
  EXPECT_NEAR(found[0]["time_std"].get<double>(), 0.01, 1e-9);
  EXPECT_LE(found[0]["time"].get<double>(), found[0]["arrival"].get<double>() + 1e-6)
      << "the sender's time on the clock that both share";
  EXPECT_EQ(found[1]["quantity"], "conductivity");
  daemon->signal(SIGTERM);
  EXPECT_EQ(daemon->wait(kInjectionPatience), 0) << daemon->err();
  EXPECT_FALSE(std::filesystem::exists(folder / "samples")) << "the socket goes with the daemon";
  Process exported({NAVCAL_PROGRAM, "log", "export", "--csv", at("csv"), log()}, folder / "export");
  EXPECT_EQ(exported.wait(kInjectionPatience), 0) << exported.err();
  const std::string table = test::read_file(folder / "csv" / "sensor.csv");
  EXPECT_NE(table.find("oxygen,umol/l,250.5"), std::string::npos) << table;
}

}  // namespace
}  // namespace navcal
