// SPDX-License-Identifier: Apache-2.0
// Emulated instruments behind a converter of serial lines to TCP (ser2net, a real one), navcald, and the replay of
// its log: what comes through the network is stamped, logged and replayed like what comes through a tty.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>

#include "tests/support/free_port.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

using test::eventually;
using test::Process;
using test::TemporaryFolder;

constexpr std::chrono::seconds kNetworkPatience{90};
constexpr const char* kConverter = "/usr/sbin/ser2net";

struct NetworkPorts : ::testing::Test {
  TemporaryFolder folder;
  std::uint16_t card_number = test::free_port(), receiver_number = test::free_port();
  std::unique_ptr<Process> emulator, converter, daemon;

  [[nodiscard]] std::string at(const std::string& name) const { return (folder / name).string(); }

  void start_emulator() {
    emulator = std::make_unique<Process>(
        std::vector<std::string>{NAVCAL_PROGRAM, "emulate", "--dir", at("ports"), "--seed", "5"},
        folder / "emulate");
    ASSERT_TRUE(eventually([&] { return emulator->out().find("ready") != std::string::npos; }, kNetworkPatience));
  }
  void start_converter() {
    std::ofstream config(folder / "ser2net.yaml");
    config << "%YAML 1.1\n---\n";
    const auto connection = [&](const char* name, std::uint16_t number, int baud) {
      config << "connection: &" << name << "\n  accepter: tcp,localhost," << number << "\n  connector: serialdev,"
             << at("ports") << "/" << name << "," << baud << "n81,local\n  options:\n    kickolduser: true\n";
    };
    connection("imu", card_number, 57600);
    connection("gps", receiver_number, 9600);
    config.close();
    converter = std::make_unique<Process>(
        std::vector<std::string>{kConverter, "-n", "-c", at("ser2net.yaml"), "-P", at("ser2net.pid")},
        folder / "ser2net");
  }
  void start_daemon() {
    std::ofstream(folder / "navcald.toml")
        << "[log]\ndirectory = \"" << at("logs")
        << "\"\nfree_floor_MB = 0\n[status]\nport = 0\n[control]\nsocket = \"" << at("control")
        << "\"\n[port.imu]\nprotocol = \"imu-card\"\naddress = \"tcp:127.0.0.1:" << card_number
        << "\"\n[port.gps]\nprotocol = \"oncore\"\naddress = \"tcp:127.0.0.1:" << receiver_number << "\"\n";
    daemon = std::make_unique<Process>(std::vector<std::string>{NAVCALD, "--config", at("navcald.toml")},
                                       folder / "navcald");
  }
  /// Lines of `navcal replay` of everything logged so far.
  [[nodiscard]] std::string replayed() const {
    std::string lines;
    std::set<std::filesystem::path> logs;
    if (!std::filesystem::exists(folder / "logs")) return lines;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "logs")) {
      if (entry.path().extension() == ".mcap") logs.insert(entry.path());
    }
    for (const auto& log : logs) {
      Process replay({NAVCAL_PROGRAM, "replay", log.string()}, folder / "replay");
      replay.wait(kNetworkPatience);
      lines += replay.out();
    }
    return lines;
  }
  static std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
  }
  void stop(Process& process, const char* name) {
    process.signal(SIGTERM);
    EXPECT_EQ(process.wait(kNetworkPatience), 0) << name << process.err();
  }
};

TEST_F(NetworkPorts, InstrumentsBehindAConverterAreReadSetUpLoggedAndReplayed) {
  if (!std::filesystem::exists(kConverter)) GTEST_SKIP() << "ser2net is not installed";
  start_emulator();
  start_converter();
  start_daemon();
  // The receiver is silent until navcald has asked it for its messages, through the converter.
  ASSERT_TRUE(eventually(
      [&] {
        const std::string lines = replayed();
        return count(lines, "\"device\":\"imu\"") > 60 && count(lines, "\"device\":\"gps\"") > 3;
      },
      kNetworkPatience))
      << daemon->err() << converter->err() << replayed().substr(0, 2000);

  // The converter goes away and comes back.
  converter->signal(SIGKILL);
  converter->wait(kNetworkPatience);
  ASSERT_TRUE(eventually([&] { return count(daemon->err(), "closed the connection") >= 2; }, kNetworkPatience))
      << daemon->err();
  const std::size_t before = count(replayed(), "\"device\":\"imu\"");
  start_converter();
  ASSERT_TRUE(eventually([&] { return count(replayed(), "\"device\":\"imu\"") > before + 40; }, kNetworkPatience))
      << daemon->err();
  stop(*daemon, "navcald ");
  stop(*emulator, "emulate ");
  converter->signal(SIGTERM);
  converter->wait(kNetworkPatience);
}

}  // namespace
}  // namespace navcal
