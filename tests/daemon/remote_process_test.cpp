// SPDX-License-Identifier: Apache-2.0
// The remote link of a running navcald: TCP and a pseudo-terminal, orders to the motor card, a link that dies.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "protocols/motor_card.h"
#include "tests/daemon/daemon_process.h"
#include "tests/daemon/link_operator.h"

namespace navcal::daemon {
namespace {

namespace card = protocols::motor_card;

class RemoteProcess : public testing::Test {
 protected:
  RemoteProcess() : port_(test::free_port()), key_file_(folder_ / "key") {
    std::ofstream(key_file_) << kRemoteSecret << "\n";
    ::chmod(key_file_.c_str(), 0600);
  }
  std::vector<std::string> settings(bool has_key, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all;
    const auto set = [&](const std::string& setting) {
      all.emplace_back("--set");
      all.push_back(setting);
    };
    set("port.compass.protocol=motor-card");
    set("command.slew_rpm_s=0");
    set("command.max_timeout_s=100");
    set("remote.dead_s=2");
    if (has_key) set("remote.key_file=" + key_file_.string());
    for (const auto& one : more) set(one);
    return all;
  }
  std::string listen() const { return "remote.listen=127.0.0.1:" + std::to_string(port_); }

  /// What the card was told last; answers with a status.
  static void serve_card(const FakeLine& line, card::Parser& parser, std::vector<int>& told) {
    const std::string bytes = line.read(0);
    parser.feed({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                [&](const protocols::Frame& frame) {
                  if (const auto command = card::decode_command(frame.bytes)) told.push_back(command->rpm);
                });
    card::Status status;
    status.rpm_commanded = status.rpm = static_cast<std::int16_t>(told.empty() ? 0 : told.back());
    const auto out = card::encode_status(status);
    line.write({reinterpret_cast<const char*>(out.data()), out.size()});
  }
  static json health(const DaemonProcess& daemon) {
    Client client(daemon.folder() / "control");
    client.send("{\"command\":\"status\"}\n");
    return json::parse(client.line().value())["health"][0];
  }
  static bool has_alarm(const DaemonProcess& daemon) {
    const json now = health(daemon);
    for (const auto& alarm : now["alarms"]) {
      if (alarm["alarm"] == "link_dead") return alarm["device"] == "remote";
    }
    return false;
  }

  test::TemporaryFolder folder_;
  std::uint16_t port_;
  std::filesystem::path key_file_;
  card::Parser parser_;
  std::vector<int> told_;
};

TEST_F(RemoteProcess, ReportsComeAndOrdersReachTheCardOverTcpWithLoss) {
  DaemonProcess daemon(settings(true, {listen()}));
  daemon.wait_until_ready();
  Operator operator_(tcp_to(port_), kRemoteSecret);
  operator_.loss = 0.3;
  operator_.work = [&] { serve_card(daemon.line, parser_, told_); };
  ASSERT_TRUE(operator_.connect());
  std::optional<link::Host::NewReport> report;
  ASSERT_TRUE(operator_.until([&] { return (report = operator_.host.take_report()).has_value(); }));
  EXPECT_TRUE(report->is_verified);
  EXPECT_EQ(report->report.holder, "");
  EXPECT_EQ(operator_.order(300).error, "no such lease");
  ASSERT_TRUE(operator_.lease(60).is_ok);
  ASSERT_TRUE(operator_.order(300).is_ok);
  ASSERT_TRUE(operator_.until([&] { return !told_.empty() && told_.back() == 300; }));
  const auto refused = operator_.order(5000);
  EXPECT_EQ(refused.error, "shaft_rpm 5000 is beyond 1200");
  EXPECT_TRUE(refused.is_in_charge) << "a refused order ends no lease";
  ASSERT_TRUE(operator_.until([&] {
    const auto next = operator_.host.take_report();
    return next && next->report.holder == "operator" && next->report.shaft_rpm == 300;
  }));
  const json status = operator_.request(R"({"command":"status"})");
  EXPECT_EQ(status["ok"], true);
  EXPECT_EQ(status["health"][0]["remote"]["operator"], "alive");
  EXPECT_EQ(operator_.request("{\"command\":\"nonsense\"}")["ok"], false);
  ASSERT_TRUE(operator_.ask({}).is_ok) << "release";
  EXPECT_TRUE(operator_.until([&] { return told_.back() == 0; }));
}

TEST_F(RemoteProcess, ADeadLinkEndsInTheSafeStateAnAlarmAndAnEventAndComesBack) {
  DaemonProcess daemon(settings(true, {listen()}));
  daemon.wait_until_ready();
  Operator operator_(tcp_to(port_), kRemoteSecret);
  operator_.work = [&] { serve_card(daemon.line, parser_, told_); };
  ASSERT_TRUE(operator_.connect());
  ASSERT_TRUE(operator_.lease(60).is_ok);
  ASSERT_TRUE(operator_.order(400).is_ok);
  ASSERT_TRUE(operator_.until([&] { return !told_.empty() && told_.back() == 400; }));
  EXPECT_FALSE(has_alarm(daemon));
  operator_.is_cut = true;
  ASSERT_TRUE(operator_.until([&] { return told_.back() == 0; }));
  EXPECT_TRUE(operator_.until([&] { return has_alarm(daemon); }));
  EXPECT_NE(daemon.diagnostics().find("remote.dead"), std::string::npos) << daemon.diagnostics();
  operator_.is_cut = false;
  ASSERT_TRUE(operator_.until([&] { return !has_alarm(daemon); }));
  EXPECT_EQ(operator_.host.sessions(), 1U) << "the session goes on";
  const auto late = operator_.order(400);
  EXPECT_NE(late.error.find("its connection was closed"), std::string::npos);
  EXPECT_FALSE(late.is_in_charge);
  EXPECT_EQ(operator_.request(R"({"command":"status"})")["ok"], true);
}

TEST_F(RemoteProcess, AnOrderThatWaitedWhileNavcaldStoodStillIsVoid) {
  DaemonProcess daemon(settings(true, {listen(), "remote.dead_s=20"}));
  daemon.wait_until_ready();
  Operator operator_(tcp_to(port_), kRemoteSecret);
  operator_.work = [&] { serve_card(daemon.line, parser_, told_); };
  ASSERT_TRUE(operator_.connect());
  ASSERT_TRUE(operator_.lease(1).is_ok);
  ASSERT_TRUE(operator_.order(400).is_ok);
  ::kill(daemon.pid(), SIGSTOP);
  link::Command late;
  late.kind = link::Command::Kind::order;
  late.shaft_rpm = 600;
  ASSERT_TRUE(operator_.host.command(remote_now_ns(), late));
  EXPECT_FALSE(operator_.until([] { return false; }, 1.5));
  ::kill(daemon.pid(), SIGCONT);
  ASSERT_TRUE(operator_.until([&] { return !told_.empty() && told_.back() == 0; }));
  EXPECT_EQ(std::count(told_.begin(), told_.end(), 600), 0);
}

TEST_F(RemoteProcess, EveryLeaseEndsWithTheLinkWhereThatIsConfigured) {
  DaemonProcess daemon(settings(true, {listen(), "remote.on_dead=safe"}));
  daemon.wait_until_ready();
  Operator operator_(tcp_to(port_), kRemoteSecret);
  operator_.work = [&] { serve_card(daemon.line, parser_, told_); };
  ASSERT_TRUE(operator_.connect());
  Client pilot(daemon.folder() / "control");
  pilot.send(R"({"command":"motor.lease","holder":"pilot","priority":1,"timeout_s":100})"
             "\n");
  const json lease = json::parse(pilot.line().value());
  ASSERT_EQ(lease["ok"], true);
  pilot.send(
      json{{"command", "motor.order"}, {"lease", lease["lease"]}, {"shaft_rpm", 200}, {"fins_deg", {0, 0, 0}}}
          .dump() +
      "\n");
  ASSERT_TRUE(operator_.until([&] { return !told_.empty() && told_.back() == 200; }));
  operator_.is_cut = true;
  EXPECT_TRUE(operator_.until([&] { return told_.back() == 0; }));
}

TEST_F(RemoteProcess, AStopEndsTheLeaseOfAnybodyElse) {
  DaemonProcess daemon(settings(true, {listen()}));
  daemon.wait_until_ready();
  Operator operator_(tcp_to(port_), kRemoteSecret);
  operator_.work = [&] { serve_card(daemon.line, parser_, told_); };
  ASSERT_TRUE(operator_.connect());
  Client other(daemon.folder() / "control");
  other.send(R"({"command":"motor.lease","holder":"other","priority":1000,"timeout_s":100})"
             "\n");
  const json lease = json::parse(other.line().value());
  ASSERT_EQ(lease["ok"], true);
  const std::string order =
      json{{"command", "motor.order"}, {"lease", lease["lease"]}, {"shaft_rpm", 200}, {"fins_deg", {0, 0, 0}}}
          .dump() +
      "\n";
  other.send(order);
  EXPECT_EQ(json::parse(other.line().value())["ok"], true);
  ASSERT_TRUE(operator_.until([&] { return !told_.empty() && told_.back() == 200; }));
  EXPECT_FALSE(operator_.lease().is_ok) << "its priority is not enough";
  link::Command stop;
  stop.kind = link::Command::Kind::stop;
  stop.holder = "operator";
  const auto answer = operator_.ask(stop);
  EXPECT_TRUE(answer.is_ok) << answer.error;
  EXPECT_FALSE(answer.is_in_charge);
  EXPECT_TRUE(operator_.until([&] { return told_.back() == 0; }));
  other.send(order);
  EXPECT_EQ(json::parse(other.line().value())["error"], "stopped by operator");
}

TEST_F(RemoteProcess, WithoutAKeyTheLinkIsReadOnlyUnlessTheConfigurationSaysOtherwise) {
  for (const bool is_open : {false, true}) {
    const auto more = std::vector<std::string>{
        listen(), std::string("remote.orders_without_key=") + (is_open ? "true" : "false")};
    DaemonProcess daemon(settings(false, more));
    daemon.wait_until_ready();
    Operator operator_(tcp_to(port_), "");
    ASSERT_TRUE(operator_.connect());
    EXPECT_EQ(operator_.lease().is_ok, is_open);
    EXPECT_EQ(operator_.request(R"({"command":"status"})")["ok"], true);
    const json mark = operator_.request(R"({"command":"event","text":"mark"})");
    EXPECT_EQ(mark["ok"], is_open);
    if (!is_open) {
      EXPECT_NE(mark["error"].get<std::string>().find("remote.key_file"), std::string::npos);
    }
  }
}

TEST_F(RemoteProcess, AnotherKeyGivesNoSessionAndAReason) {
  DaemonProcess daemon(settings(true, {listen()}));
  daemon.wait_until_ready();
  Operator operator_(tcp_to(port_), "a secret that is not the vehicle's");
  link::Refusal why = link::Refusal::none;
  ASSERT_TRUE(operator_.until([&] { return (why = operator_.host.take_refusal()) != link::Refusal::none; }));
  EXPECT_EQ(why, link::Refusal::bad_tag);
  EXPECT_FALSE(operator_.host.has_session());
  EXPECT_GT(health(daemon)["remote"]["refused"], 0);
}

TEST_F(RemoteProcess, TheLinkRunsOnAPseudoTerminalThatGoesAndComesBack) {
  const auto modem = folder_ / "modem";
  auto line = std::make_unique<FakeLine>();
  std::filesystem::create_symlink(line->path(), modem);
  DaemonProcess daemon(settings(true, {"remote.path=" + modem.string()}));
  daemon.wait_until_ready();
  for (int i = 0; i < 2; ++i) {
    // The master of the pseudo-terminal is the operator's modem.
    Operator operator_(::dup(line->master()), kRemoteSecret);
    ASSERT_TRUE(operator_.connect()) << i;
    EXPECT_EQ(operator_.request(R"({"command":"status"})")["ok"], true);
    std::filesystem::remove(modem);
    line = std::make_unique<FakeLine>();
    std::filesystem::create_symlink(line->path(), modem);
  }
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
  EXPECT_NE(daemon.diagnostics().find("remote.lost"), std::string::npos);
}

TEST_F(RemoteProcess, AKeyThatOthersCanReadAndAnAddressThatIsTakenAreRefused) {
  DaemonProcess daemon(settings(false, {listen()}));
  daemon.wait_until_ready();
  const auto more = [](const std::string& setting) { return std::vector<std::string>{"--set", setting}; };
  auto others = more("status.port=0");
  others.insert(others.end(), {"--set", "control.socket=" + (folder_ / "other").string(), "--set",
                               "log.directory=" + (folder_ / "other-log").string()});
  const auto taken = daemon.run_another(others);
  EXPECT_EQ(taken.first, 1);
  EXPECT_NE(taken.second.find("remote.listen"), std::string::npos) << taken.second;
  ::chmod(key_file_.c_str(), 0644);
  others.insert(others.end(), {"--set", "remote.key_file=" + key_file_.string()});
  const auto open = daemon.run_another(others);
  EXPECT_EQ(open.first, 1);
  EXPECT_NE(open.second.find("chmod 600"), std::string::npos) << open.second;
}

}  // namespace
}  // namespace navcal::daemon
