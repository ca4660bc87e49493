// SPDX-License-Identifier: Apache-2.0
// navcal remote and navcald over a relay that loses a third of what passes, with the emulated motor card of navcal
// emulate.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <pty.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <atomic>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "base/descriptor.h"
#include "link/frame.h"
#include "tests/daemon/tcp_client.h"
#include "tests/support/free_port.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

using nlohmann::json;
using test::eventually;
using test::Process;

constexpr std::chrono::seconds kLong{120};

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// Passes frames between an operator, who connects to it, and the vehicle; loses some by a seed.
class Relay {
 public:
  Relay(std::uint16_t vehicle, double loss)
      : vehicle_port_(vehicle), loss_(loss), listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = loopback(0);
    socklen_t length = sizeof address;
    ::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), length);
    ::listen(listener_.get(), 4);
    ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &length);
    port = ntohs(address.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~Relay() {
    stopped_ = true;
    thread_.join();
  }
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  std::uint16_t port = 0;
  std::atomic<bool> is_cut{false};

 private:
  void run() {
    while (!stopped_) {
      pollfd waiting{listener_.get(), POLLIN, 0};
      if (::poll(&waiting, 1, 20) <= 0) continue;
      const base::Descriptor left(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
      const base::Descriptor right(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
      const sockaddr_in address = loopback(vehicle_port_);
      if (::connect(right.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) continue;
      link::Parser up, down;
      while (!stopped_ && pass(left.get(), right.get(), up, down)) continue;
    }
  }
  bool pass(int left, int right, link::Parser& up, link::Parser& down) {
    std::array<pollfd, 2> ready{{{left, POLLIN, 0}, {right, POLLIN, 0}}};
    if (::poll(ready.data(), 2, 20) <= 0) return true;
    return (ready[0].revents == 0 || copy(left, right, up)) && (ready[1].revents == 0 || copy(right, left, down));
  }
  bool copy(int from, int to, link::Parser& parser) {
    std::array<std::uint8_t, 4096> bytes{};
    const ssize_t n = ::recv(from, bytes.data(), bytes.size(), 0);
    if (n <= 0) return false;
    parser.feed({bytes.data(), static_cast<std::size_t>(n)}, [&](const protocols::Frame& frame) {
      if (is_cut || static_cast<double>(random_() % 1000) < 1000 * loss_) return;
      (void)::send(to, frame.bytes.data(), frame.bytes.size(), MSG_NOSIGNAL);
    });
    return true;
  }

  std::uint16_t vehicle_port_;
  double loss_;
  base::Descriptor listener_;
  std::mt19937 random_{7};
  std::atomic<bool> stopped_{false};
  std::thread thread_;
};

class Remote : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "key") << "one key for both ends of the link\n";
    ::chmod((folder_ / "key").c_str(), 0600);
    for (const char* const name : {"console", "typed"}) {
      ASSERT_EQ(::mkfifo((folder_ / name).c_str(), 0600), 0);
    }
    // Kept open here, so that nobody sees the end of an input before the test wants it.
    console_ = base::Descriptor(::open((folder_ / "console").c_str(), O_RDWR | O_CLOEXEC));
    typed_ = base::Descriptor(::open((folder_ / "typed").c_str(), O_RDWR | O_CLOEXEC));
    const std::string emulate = "exec " NAVCAL_PROGRAM " emulate --vehicle --dir " + (folder_ / "ports").string() +
                                " < " + (folder_ / "console").string();
    emulator_ = std::make_unique<Process>(std::vector<std::string>{"sh", "-c", emulate}, folder_ / "emulate");
    ASSERT_TRUE(eventually([&] { return emulator_->out().find("ready") != std::string::npos; }, kLong))
        << emulator_->err();
    vehicle_port_ = test::free_port();
    std::vector<std::string> daemon{NAVCALD, "--config", NAVCAL_SOURCE_DIR "/config/navcald.toml"};
    const auto set = [&](const std::string& key, const std::string& value) {
      daemon.insert(daemon.end(), {"--set", key + "=" + value});
    };
    for (const std::string port : {"compass", "imu", "gps", "motor"})
      set("port." + port + ".path", (folder_ / "ports" / port).string());
    set("log.directory", (folder_ / "logs").string());
    set("log.free_floor_MB", "0");
    set("control.socket", (folder_ / "control").string());
    set("status.port", "0");
    set("remote.listen", "127.0.0.1:" + std::to_string(vehicle_port_));
    set("remote.key_file", (folder_ / "key").string());
    set("remote.dead_s", "3");
    set("remote.budget_B_s", "50000");  // a copy of a log would take minutes
    daemon_ = std::make_unique<Process>(daemon, folder_ / "navcald");
    ASSERT_TRUE(eventually([&] { return daemon_->err().find("motor port.opened") != std::string::npos; }, kLong))
        << daemon_->err();
  }
  [[nodiscard]] std::unique_ptr<Process> remote(std::uint16_t port, const std::string& arguments,
                                                const std::string& name, bool has_key = true) const {
    const std::string command = "exec " NAVCAL_PROGRAM " remote tcp:127.0.0.1:" + std::to_string(port) + " " +
                                arguments + (has_key ? " --key-file " + (folder_ / "key").string() : "") + " < " +
                                (folder_ / "typed").string();
    return std::make_unique<Process>(std::vector<std::string>{"sh", "-c", command}, folder_ / name);
  }
  void type(std::string_view line) const {
    ASSERT_EQ(::write(typed_.get(), line.data(), line.size()), static_cast<ssize_t>(line.size()));
  }
  /// Lines of a class, whole ones only.
  static std::vector<json> lines(const Process& process, std::string_view of) {
    std::vector<json> found;
    std::istringstream text(process.out());
    for (std::string line; std::getline(text, line) && !text.eof();) {
      json object = json::parse(line, nullptr, false);
      if (object.is_object() && object.value("class", "") == of) found.push_back(std::move(object));
    }
    return found;
  }
  [[nodiscard]] std::size_t times_said(std::string_view words) const {
    const std::string said = daemon_->err();
    std::size_t times = 0;
    for (auto at = said.find(words); at != std::string::npos; at = said.find(words, at + 1)) ++times;
    return times;
  }
  /// The daemon's answer on its control socket.
  [[nodiscard]] json ask(const std::string& line) const {
    daemon::Client client(folder_ / "control");
    client.send(line + "\n");
    return json::parse(client.line().value());
  }
  static double shaft_rpm(const Process& process) {
    const auto reports = lines(process, "REPORT");
    return reports.empty() || reports.back()["shaft_rpm"].is_null() ? -1
                                                                    : reports.back()["shaft_rpm"].get<double>();
  }

  test::TemporaryFolder folder_;
  base::Descriptor console_, typed_;
  std::unique_ptr<Process> emulator_, daemon_;
  std::uint16_t vehicle_port_ = 0;
};

TEST_F(Remote, SteersThroughALossyRelayAndTheVehicleStopsWhenTheLinkIsCut) {
  Relay relay(vehicle_port_, 0.3);
  const auto process = remote(relay.port, "--json", "remote");
  ASSERT_TRUE(eventually([&] { return lines(*process, "REPORT").size() > 2; }, kLong)) << process->err();
  const json report = lines(*process, "REPORT").back();
  EXPECT_EQ(report["verified"], true);
  EXPECT_TRUE(report["heading_deg"].is_number());
  EXPECT_TRUE(report["depth_m"].is_number());
  type("lease\n");
  ASSERT_TRUE(eventually([&] { return !lines(*process, "ANSWER").empty(); }, kLong));
  EXPECT_EQ(lines(*process, "ANSWER").back()["ok"], true);
  type("order 300 1 0 0\n");
  ASSERT_TRUE(eventually([&] { return shaft_rpm(*process) > 250; }, kLong)) << process->out();
  type("send {\"command\":\"event\",\"text\":\"over the link\"}\n");
  ASSERT_TRUE(eventually([&] { return !lines(*process, "RESPONSE").empty(); }, kLong));
  EXPECT_EQ(lines(*process, "RESPONSE").back()["response"]["ok"], true);
  EXPECT_NE(daemon_->err().find("over the link"), std::string::npos);

  relay.is_cut = true;
  ASSERT_TRUE(eventually([&] { return daemon_->err().find("remote.dead") != std::string::npos; }, kLong));
  ASSERT_TRUE(eventually([&] { return daemon_->err().find("motor.safe") != std::string::npos; }, kLong))
      << daemon_->err();
  relay.is_cut = false;
  ASSERT_TRUE(eventually([&] { return shaft_rpm(*process) >= 0 && shaft_rpm(*process) < 20; }, kLong));
  ASSERT_TRUE(
      eventually([&] { return daemon_->err().find("alarm.cleared: link_dead") != std::string::npos; }, kLong));
  // The first order that is refused says that the lease is over; it is not repeated.
  ASSERT_TRUE(eventually([&] { return lines(*process, "ANSWER").back()["ok"] == false; }, kLong));
  const auto answers = lines(*process, "ANSWER").size();
  type("order 100 0 0 0\n");
  ASSERT_TRUE(eventually([&] { return !lines(*process, "NOTICE").empty(); }, kLong));
  EXPECT_EQ(lines(*process, "ANSWER").size(), answers);
  process->signal(SIGINT);
  EXPECT_EQ(process->wait(kLong), 0) << process->err();
}

TEST_F(Remote, EverySignalThatEndsItGivesTheLeaseBack) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE(signal);
    const std::size_t released = times_said("the lease was released");
    const std::size_t left = times_said("the operator has left the link");
    const auto process = remote(vehicle_port_, "--json", "remote" + std::to_string(signal));
    type("lease\n");
    ASSERT_TRUE(eventually([&] { return !lines(*process, "ANSWER").empty(); }, kLong)) << process->err();
    type("order 300 0 0 0\n");
    ASSERT_TRUE(eventually([&] { return shaft_rpm(*process) > 250; }, kLong));
    process->signal(signal);
    EXPECT_EQ(process->wait(kLong), 0) << process->err();
    EXPECT_TRUE(eventually([&] { return times_said("the lease was released") == released + 1; }, kLong))
        << daemon_->err();
    EXPECT_TRUE(eventually([&] { return times_said("the operator has left the link") == left + 1; }, kLong));
  }
  EXPECT_EQ(times_said("alarm.raised: link_dead"), 0U);
}

TEST_F(Remote, ATerminalThatIsClosedGivesTheLeaseBack) {
  int terminal = -1;
  const std::string address = "tcp:127.0.0.1:" + std::to_string(vehicle_port_);
  const std::string key = folder_ / "key";
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(child, 0);
  if (child == 0) {
    test::die_with_parent();
    ::execl(NAVCAL_PROGRAM, NAVCAL_PROGRAM, "remote", address.c_str(), "--key-file", key.c_str(), nullptr);
    ::_exit(127);
  }
  ASSERT_EQ(::fcntl(terminal, F_SETFL, O_NONBLOCK), 0);
  std::string seen;
  const auto shown = [&] {
    std::array<char, 4096> bytes{};
    for (ssize_t n = 0; (n = ::read(terminal, bytes.data(), bytes.size())) > 0;)
      seen.append(bytes.data(), static_cast<std::size_t>(n));
  };
  const auto enter = [&](std::string_view line) {
    ASSERT_EQ(::write(terminal, line.data(), line.size()), static_cast<ssize_t>(line.size()));
  };
  enter("lease\n");
  ASSERT_TRUE(eventually(
      [&] {
        shown();
        return seen.find("ok\r\n") != std::string::npos;
      },
      kLong))
      << seen;
  enter("order 300 0 0 0\n");
  ASSERT_TRUE(eventually(
      [&] {
        shown();
        return ask(R"({"command":"status"})")["health"][0]["motor"]["shaft_rpm"] == 300;
      },
      kLong))
      << seen;
  ::close(terminal);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status)) << status;
  EXPECT_TRUE(eventually([&] { return times_said("the lease was released") == 1; }, kLong)) << daemon_->err();
}

TEST_F(Remote, StopEndsTheLeaseOfAnybodyElse) {
  daemon::Client other(folder_ / "control");
  other.send("{\"command\":\"motor.lease\",\"holder\":\"other\",\"priority\":1000,\"timeout_s\":5}\n");
  const json lease = json::parse(other.line().value());
  ASSERT_EQ(lease["ok"], true);
  const std::string order =
      json{{"command", "motor.order"}, {"lease", lease["lease"]}, {"shaft_rpm", 200}, {"fins_deg", {0, 0, 0}}}
          .dump() +
      "\n";
  std::string why;
  const auto stop = remote(vehicle_port_, "stop --holder the-boat", "stop");
  // The lease lives by its orders until it is stopped.
  ASSERT_TRUE(eventually(
      [&] {
        other.send(order);
        why = json::parse(other.line().value()).value("error", "");
        return why.starts_with("stopped");
      },
      kLong));
  EXPECT_EQ(why, "stopped by the-boat");
  EXPECT_EQ(stop->wait(kLong), 0) << stop->err();
  EXPECT_NE(stop->out().find("stopped"), std::string::npos);
  EXPECT_EQ(ask(R"({"command":"status"})")["health"][0]["motor"]["safe"], true);
}

TEST_F(Remote, AsksOnceAndWithoutAKeyOnlyWatches) {
  const auto once = remote(vehicle_port_, "status", "once");
  ASSERT_EQ(once->wait(kLong), 0) << once->err();
  EXPECT_EQ(json::parse(once->out())["ok"], true);
  const auto keyless = remote(vehicle_port_, "status --wait 86400", "keyless", false);
  EXPECT_EQ(keyless->wait(kLong), 1) << "it waits although no key will come";
  EXPECT_NE(keyless->err().find("the vehicle has a key"), std::string::npos) << keyless->err();
  EXPECT_NE(keyless->err().find("--key-file"), std::string::npos) << keyless->err();
  const auto watcher = remote(vehicle_port_, "--seconds 5", "watcher", false);
  EXPECT_EQ(watcher->wait(kLong), 0);
  EXPECT_NE(watcher->out().find("not authenticated"), std::string::npos) << watcher->out();
}

TEST_F(Remote, CopiesALogAndGoesOnWhereItWasInterrupted) {
  const auto rotate = remote(vehicle_port_, "send '{\"command\":\"log.rotate\"}'", "rotate");
  ASSERT_EQ(rotate->wait(kLong), 0) << rotate->err();
  const auto list = remote(vehicle_port_, "ls", "list");
  ASSERT_EQ(list->wait(kLong), 0) << list->err();
  std::istringstream first(list->out());
  std::uint64_t bytes = 0;
  std::string name;
  ASSERT_TRUE(first >> bytes >> name) << list->out();
  const std::string log = test::read_file(folder_ / "logs" / name);
  ASSERT_EQ(log.size(), bytes);
  // What an interrupted copy has left, and what belongs to another log.
  for (const std::string& part : {log.substr(0, log.size() / 2), std::string(100, 'x')}) {
    const auto target = folder_ / "copy";
    std::filesystem::remove(target);
    std::ofstream(target.string() + ".part", std::ios::binary) << part;
    const auto get = remote(vehicle_port_, "get " + name + " -o " + target.string(), "get");
    ASSERT_EQ(get->wait(kLong), 0) << get->err();
    EXPECT_TRUE(test::read_file(target) == log);
    EXPECT_FALSE(std::filesystem::exists(target.string() + ".part"));
  }
}

}  // namespace
}  // namespace navcal
