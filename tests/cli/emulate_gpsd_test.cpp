// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "emulate_program.h"
#include "sim/geodesy.h"
#include "tests/ports/harness.h"
#include "tests/support/free_port.h"

namespace navcal::cli::test {
namespace {

using navcal::test::free_port;

constexpr const char* kGpsd = "/usr/sbin/gpsd";

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// Debian's gpsd on one device, ended by its id.
class Gpsd {
 public:
  Gpsd(const std::string& device, std::uint16_t port) : port_(port) {
    const std::string service = std::to_string(port);
    pid_ = ::fork();
    if (pid_ != 0) return;
    ::execl(kGpsd, kGpsd, "-N", "-n", "-S", service.c_str(), device.c_str(), nullptr);
    ::_exit(127);
  }
  ~Gpsd() {
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
  }

  /// The first TPV with a position within the time; null otherwise.
  [[nodiscard]] nlohmann::json position(std::chrono::seconds limit) const {
    const auto end = std::chrono::steady_clock::now() + limit;
    const base::Descriptor client = connected(end);
    const std::string watch = "?WATCH={\"enable\":true,\"json\":true};\n";
    if (!client || ::write(client.get(), watch.data(), watch.size()) < 0) return nullptr;
    const timeval patience{1, 0};
    ::setsockopt(client.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    std::string line;
    while (std::chrono::steady_clock::now() < end) {
      char byte = 0;
      if (::read(client.get(), &byte, 1) != 1) continue;
      if (byte != '\n') {
        line += byte;
        continue;
      }
      const auto report = nlohmann::json::parse(line, nullptr, false);
      line.clear();
      if (report.is_object() && report.value("class", "") == "TPV" && report.contains("lat")) return report;
    }
    return nullptr;
  }

 private:
  [[nodiscard]] base::Descriptor connected(std::chrono::steady_clock::time_point end) const {
    while (std::chrono::steady_clock::now() < end) {
      base::Descriptor client(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
      const sockaddr_in address = loopback(port_);
      if (::connect(client.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return client;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return {};
  }

  pid_t pid_ = -1;
  std::uint16_t port_;
};

void expect_gpsd_reads(const std::string& kind) {
  if (!std::filesystem::exists(kGpsd)) {
    std::printf("%s is absent\n", kGpsd);
    GTEST_SKIP();
  }
  const ports::testing::Folder folder;
  Program program({"emulate", "--dir", folder.path().string(), "--gps", kind});
  ASSERT_EQ(program.line(), "ready");
  // gpsd wants a device it need not resolve: the link leads to the pseudo-terminal.
  const std::uint16_t port = free_port();
  const Gpsd gpsd(std::filesystem::canonical(folder.path() / "gps").string(), port);
  const auto report = gpsd.position(std::chrono::seconds(90));
  ASSERT_TRUE(report.is_object()) << "no position from gpsd";
  const sim::Origin origin;
  EXPECT_NEAR(report["lat"].get<double>(), origin.latitude_deg, 0.002) << report.dump();
  EXPECT_NEAR(report["lon"].get<double>(), origin.longitude_deg, 0.002) << report.dump();
}

TEST(EmulateGpsd, ReadsThePositionOfAnOncore) { expect_gpsd_reads("ha"); }
TEST(EmulateGpsd, ReadsThePositionOfTodaysReceiver) { expect_gpsd_reads("nmea"); }

}  // namespace
}  // namespace navcal::cli::test
