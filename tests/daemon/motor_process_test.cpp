// SPDX-License-Identifier: Apache-2.0
// Orders to the motor card through a running navcald: control socket, pseudo-terminal, log.
#include <gtest/gtest.h>

#include <future>
#include <nlohmann/json.hpp>

#include "protocols/motor_card.h"
#include "record/recording.h"
#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;
namespace motor = protocols::motor_card;

/// The card at the other end of the line: notes what it is told, and says what it was told last.
class Card {
 public:
  explicit Card(const FakeLine& line) : line_(line) {}

  /// Hears and speaks until `holds()`, or for so many statuses.
  template <class Condition>
  bool serve_until(Condition holds, int statuses = 2000) {
    for (int i = 0; i < statuses; ++i) {
      hear();
      if (holds()) return true;
      if (line_.is_closed()) {
        ::usleep(5000);
      } else if (!silent) {
        speak();
      }
    }
    return false;
  }
  bool serve_until_told(const motor::Command& command) {
    return serve_until([&] { return !heard.empty() && heard.back() == command; });
  }

  std::vector<motor::Command> heard;
  bool deaf = false;    ///< obeys nothing of what it hears
  bool silent = false;  ///< sends no status

 private:
  void hear() {
    const std::string bytes = line_.read(20);
    parser_.feed({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                 [&](const protocols::Frame& frame) {
                   const auto command = motor::decode_command(frame.bytes);
                   if (!command) return;
                   heard.push_back(*command);
                   if (!deaf) obeyed_ = *command;
                 });
  }
  void speak() {
    motor::Status status;
    status.sequence = sequence_++;
    status.rpm_commanded = status.rpm = obeyed_.rpm;
    status.fins_deg = {obeyed_.fins_deg[0], obeyed_.fins_deg[1], obeyed_.fins_deg[2]};
    const auto bytes = motor::encode_status(status);
    line_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  const FakeLine& line_;
  motor::Parser parser_;
  motor::Command obeyed_;
  std::uint8_t sequence_ = 0;
};

/// One connection to the control socket.
class Controller {
 public:
  explicit Controller(const DaemonProcess& daemon) : client_(daemon.folder() / "control") {}
  json ask(const json& request) {
    client_.send(request.dump() + "\n");
    return json::parse(client_.line().value());
  }
  json lease(const std::string& holder, int priority, double timeout_s) {
    const json answer =
        ask({{"command", "motor.lease"}, {"holder", holder}, {"priority", priority}, {"timeout_s", timeout_s}});
    if (answer["ok"] == true) token_ = answer["lease"];
    return answer;
  }
  json order(double rpm, const std::vector<double>& fins_deg = {0, 0, 0}, const json& state_time = {}) {
    json request{{"command", "motor.order"}, {"lease", token_}, {"shaft_rpm", rpm}, {"fins_deg", fins_deg}};
    if (!state_time.is_null()) request["state_time"] = state_time;
    return ask(request);
  }
  json release() { return ask({{"command", "motor.release"}, {"lease", token_}}); }
  json health() { return ask({{"command", "status"}})["health"][0]; }
  [[nodiscard]] const std::string& token() const { return token_; }
  Client& client() { return client_; }

 private:
  Client client_;
  std::string token_ = "none";
};

class MotorProcess : public testing::Test {
 protected:
  MotorProcess()
      : daemon_({"--set", "port.compass.protocol=motor-card", "--set", "command.max_timeout_s=100", "--set",
                 "command.slew_rpm_s=0", "--set", "command.slew_fin_deg_s=0", "--set",
                 "command.echo_timeout_s=0.3"}) {
    daemon_.wait_until_ready();
    wait_until_open();
  }
  void wait_until_open() {
    Controller controller(daemon_);
    for (int i = 0; i < 2000 && controller.health()["ports"][0]["opened"] == 0; ++i) ::usleep(5000);
  }
  /// The card is at work until navcald has ended; its exit status. Signal 0: it ends by itself.
  int stop(int signal = SIGTERM) {
    auto ended = std::async(std::launch::async, [this, signal] { return daemon_.stop(signal); });
    card_.serve_until([&] { return ended.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
    return ended.get();
  }
  /// What became of orders, as the log has it.
  std::vector<json> commands() {
    std::vector<json> found;
    for (const auto& file : daemon_.logs()) {
      const auto recording = record::Recording::open(file);
      while (auto entry = recording->next()) {
        if (const auto* command = std::get_if<record::LoggedCommand>(&*entry))
          found.push_back(json::parse(command->json));
      }
      EXPECT_TRUE(recording->remarks().empty());
    }
    return found;
  }

  static constexpr double kLong_s = 100;
  static constexpr motor::Command kSafe{};
  DaemonProcess daemon_;
  Card card_{daemon_.line};
};

TEST_F(MotorProcess, AnOrderIsOnTheWireEchoedLoggedAndEndsInTheSafeState) {
  Controller pilot(daemon_);
  EXPECT_EQ(card_.serve_until([&] { return !card_.heard.empty(); }, 20), false) << "nothing before a lease";
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  EXPECT_EQ(pilot.token().size(), 32U);
  const json answer = pilot.order(780, {0, -5.25, 5});
  ASSERT_EQ(answer["ok"], true) << answer;
  EXPECT_EQ(answer["sequence"], 1);
  EXPECT_EQ(answer["shaped"], false);
  EXPECT_GT(answer["sent"].get<double>(), 1e9);
  ASSERT_TRUE(card_.serve_until_told({780, {0, -5.3, 5}}));
  ASSERT_TRUE(card_.serve_until([&] { return pilot.health()["motor"]["echoed"] == 1; }));
  const json health = pilot.health()["motor"];
  EXPECT_EQ(health["holder"], "pilot");
  EXPECT_EQ(health["shaft_rpm"], 780);
  EXPECT_EQ(health["safe"], false);
  EXPECT_GT(health["echo_s"].get<double>(), 0);
  ASSERT_EQ(stop(), 0) << daemon_.diagnostics();
  EXPECT_EQ(card_.heard.back(), kSafe) << "the shaft stands when navcald ends";

  const auto logged = commands();
  ASSERT_EQ(logged.size(), 2U);
  EXPECT_EQ(logged[0]["outcome"], "echoed");
  EXPECT_EQ(logged[0]["source"], "order");
  EXPECT_EQ(logged[0]["holder"], "pilot");
  EXPECT_LT(logged[0]["asked"], logged[0]["sent"]);
  EXPECT_LT(logged[0]["sent"], logged[0]["echoed"]);
  EXPECT_EQ(logged[0]["sent"], answer["sent"]);
  EXPECT_EQ(logged[0]["fins_deg"], json::parse("[0.0,-5.25,5.0]"));
  EXPECT_EQ(logged[0]["shaft_sent_rpm"], 780);
  EXPECT_EQ(logged[1]["source"], "safe");
  std::string sent;
  const auto recording = record::Recording::open(daemon_.logs()[0]);
  while (auto entry = recording->next()) {
    const auto* raw = std::get_if<record::RawRead>(&*entry);
    if (raw != nullptr && raw->direction == record::Direction::sent)
      sent.append(raw->bytes.begin(), raw->bytes.end());
  }
  const auto first = motor::encode_command({780, {0, -5.3, 5}}), last = motor::encode_command(kSafe);
  EXPECT_EQ(sent, std::string(first.begin(), first.end()) + std::string(last.begin(), last.end()));
}

TEST_F(MotorProcess, OfTwoControllersTheOneWithTheHigherPriorityIsInCharge) {
  Controller pilot(daemon_), second(daemon_), human(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  ASSERT_EQ(pilot.order(500)["ok"], true);
  EXPECT_EQ(second.lease("second", 1, kLong_s)["error"], "the lease is held by pilot (priority 1)");
  EXPECT_EQ(second.order(100)["error"], "no such lease");
  ASSERT_EQ(human.lease("operator", 2, kLong_s)["ok"], true);
  EXPECT_EQ(pilot.order(600)["error"], "preempted by operator (priority 2)");
  EXPECT_EQ(pilot.release()["error"], "preempted by operator (priority 2)");
  ASSERT_EQ(human.order(-50, {1, 2, 3})["ok"], true);
  EXPECT_TRUE(card_.serve_until_told({-50, {1, 2, 3}}));
  EXPECT_EQ(human.release()["ok"], true);
  EXPECT_TRUE(card_.serve_until_told(kSafe));
  EXPECT_EQ(human.order(10)["error"], "the lease was released");
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  EXPECT_EQ(pilot.order(600)["ok"], true);
}

TEST_F(MotorProcess, AControllerThatDiesLeavesTheShaftStanding) {
  {
    Controller pilot(daemon_);
    ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
    ASSERT_EQ(pilot.order(500)["ok"], true);
    ASSERT_TRUE(card_.serve_until_told({500, {}}));
  }
  EXPECT_TRUE(card_.serve_until_told(kSafe));
}

TEST_F(MotorProcess, AControllerThatFallsSilentLeavesTheShaftStanding) {
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, 0.2)["ok"], true);
  // On a loaded machine the order may come too late; the safe state follows then, too.
  static_cast<void>(pilot.order(500));
  EXPECT_TRUE(card_.serve_until_told(kSafe));
  EXPECT_EQ(pilot.order(500)["error"], "the lease expired: no order came for 0.2 s");
}

TEST_F(MotorProcess, ADaemonThatWasKilledOrdersTheSafeStateWhenItIsBack) {
  const auto note = daemon_.folder() / "log" / "motor.commanded";
  {
    Controller pilot(daemon_);
    ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
    ASSERT_EQ(pilot.order(500)["ok"], true);
    ASSERT_TRUE(card_.serve_until_told({500, {}}));
    ASSERT_TRUE(card_.serve_until([&] { return std::filesystem::exists(note); }));
    daemon_.stop(SIGKILL);
  }
  EXPECT_EQ(card_.heard.back(), (motor::Command{500, {}})) << "nobody could tell it";
  daemon_.start_again();
  EXPECT_TRUE(card_.serve_until_told(kSafe));
  EXPECT_TRUE(card_.serve_until([&] { return !std::filesystem::exists(note); })) << "the card has shown it";
  EXPECT_EQ(daemon_.stop(SIGTERM), 0);
  const auto before = card_.heard.size();
  daemon_.start_again();
  daemon_.wait_until_ready();
  wait_until_open();
  EXPECT_FALSE(card_.serve_until([&] { return card_.heard.size() > before; }, 20))
      << "now there is nothing to undo";
}

TEST_F(MotorProcess, ACardThatDoesNotEchoRaisesAnAlarmUntilItDoes) {
  Client watcher(daemon_.port());
  watcher.send("?WATCH={\"enable\":true,\"json\":true,\"classes\":[\"HEALTH\"]};\n");
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  card_.deaf = true;
  ASSERT_EQ(pilot.order(500)["ok"], true);
  const auto alarm = [&] {
    const json health = pilot.health();
    return health["alarms"].empty() ? std::string() : health["alarms"][0]["alarm"].get<std::string>();
  };
  ASSERT_TRUE(card_.serve_until([&] { return !alarm().empty(); }));
  EXPECT_EQ(alarm(), "command_not_echoed");
  EXPECT_NE(watcher.line_with("command_not_echoed").find("\"class\":\"HEALTH\""), std::string::npos);
  EXPECT_GE(pilot.health()["motor"]["not_echoed"], 1);
  card_.deaf = false;
  ASSERT_EQ(pilot.order(501)["ok"], true);
  EXPECT_TRUE(card_.serve_until([&] { return alarm().empty(); }));
}

TEST_F(MotorProcess, ASilentCardIsNoEcho) {
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  card_.silent = true;
  ASSERT_EQ(pilot.order(500)["ok"], true);
  EXPECT_TRUE(card_.serve_until([&] { return !pilot.health()["alarms"].empty(); }));
}

TEST_F(MotorProcess, WhatCannotBeIsRefusedAndSaysWhy) {
  Controller pilot(daemon_);
  EXPECT_EQ(pilot.order(1)["error"], "no such lease");
  EXPECT_EQ(pilot.lease("pilot", 1, 0.01)["error"], "timeout_s is 0.2 to 100");
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  EXPECT_EQ(pilot.order(1201)["error"], "shaft_rpm 1201 is beyond 1200");
  EXPECT_EQ(pilot.order(0, {0, -26, 0})["error"], "fins_deg[1] -26 is beyond 25");
  EXPECT_EQ(pilot.order(0, {0, 0})["error"], "fins_deg is three numbers");
  EXPECT_EQ(pilot.ask({{"command", "motor.order"}, {"lease", pilot.token()}})["error"], "shaft_rpm is a number");
  EXPECT_EQ(pilot.health()["motor"]["refused"], 3);
  EXPECT_EQ(pilot.health()["motor"]["refusal"], "fins_deg[1] -26 is beyond 25");
  EXPECT_FALSE(card_.serve_until([&] { return !card_.heard.empty(); }, 20));
  ASSERT_EQ(stop(), 0);
  const auto logged = commands();
  ASSERT_GE(logged.size(), 3U);
  EXPECT_EQ(logged[1]["outcome"], "refused");
  EXPECT_EQ(logged[1]["shaft_rpm"], 1201);
  EXPECT_EQ(logged[1]["reason"], "shaft_rpm 1201 is beyond 1200");
  EXPECT_TRUE(logged[1]["sent"].is_null());
}

TEST_F(MotorProcess, AFloodHurtsNobody) {
  Controller flood(daemon_), other(daemon_);
  ASSERT_EQ(flood.lease("flood", 1, kLong_s)["ok"], true);
  const std::string order =
      json{{"command", "motor.order"}, {"lease", flood.token()}, {"shaft_rpm", 1}, {"fins_deg", {0, 0, 0}}}
          .dump() +
      "\n";
  constexpr int kOrders = 600;
  std::string all;
  for (int i = 0; i < kOrders; ++i) all += order;
  flood.client().send(all);
  int taken = 0;
  json last;
  for (int i = 0; i < kOrders; ++i) {
    last = json::parse(flood.client().line().value());
    taken += last["ok"] == true ? 1 : 0;
    if (i % 100 == 0) {
      EXPECT_EQ(other.health()["ports"][0]["state"], "running");
    }
  }
  EXPECT_GT(taken, 0);
  EXPECT_LT(taken, 200);
  EXPECT_EQ(last["error"], "its connection sends too many lines") << "its lease is lost";
  EXPECT_TRUE(card_.serve_until_told(kSafe));
  // Somebody else is in charge at once, whatever the flood goes on with.
  flood.client().send(all);
  ASSERT_EQ(other.lease("other", 1, kLong_s)["ok"], true);
  EXPECT_EQ(other.order(7)["ok"], true);
  EXPECT_TRUE(card_.serve_until_told({7, {}}));
}

TEST_F(MotorProcess, TheNoteIsThereWhenTheLeaseIsAndGoesWhenTheCardHasShownTheSafeState) {
  const auto note = daemon_.folder() / "log" / "motor.commanded";
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  EXPECT_TRUE(std::filesystem::exists(note)) << "before the first order";
  ASSERT_EQ(pilot.order(500)["ok"], true);
  ASSERT_TRUE(card_.serve_until_told({500, {}}));
  card_.deaf = true;
  ASSERT_EQ(pilot.release()["ok"], true);
  ASSERT_TRUE(card_.serve_until_told(kSafe));
  EXPECT_FALSE(card_.serve_until([&] { return !std::filesystem::exists(note); }, 30)) << "sent is not shown";
  card_.deaf = false;
  EXPECT_TRUE(card_.serve_until([&] { return !std::filesystem::exists(note); }));
}

TEST_F(MotorProcess, WithoutANoteNobodyGetsALease) {
  // At one stroke: the daemon may be making a file in it.
  std::filesystem::rename(daemon_.folder() / "log", daemon_.folder() / "log-away");
  std::ofstream(daemon_.folder() / "log") << "no folder any more";
  Controller pilot(daemon_);
  const std::string error = pilot.lease("pilot", 1, kLong_s)["error"];
  EXPECT_NE(error.find("motor.commanded"), std::string::npos) << error;
  EXPECT_EQ(pilot.order(500)["error"], "no such lease");
  EXPECT_EQ(pilot.health()["alarms"][0]["alarm"], "orders_refused");
  EXPECT_EQ(pilot.ask({{"command", "motor.stop"}})["ok"], true) << "stopping needs no note";
  EXPECT_TRUE(card_.serve_until_told(kSafe));
  std::filesystem::remove(daemon_.folder() / "log");
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  const json health = pilot.health();
  for (const json& alarm : health["alarms"]) EXPECT_NE(alarm["alarm"], "orders_refused");
}

TEST_F(MotorProcess, TheEndRepeatsTheSafeStateUntilTheCardShowsIt) {
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  ASSERT_EQ(pilot.order(500)["ok"], true);
  ASSERT_TRUE(card_.serve_until_told({500, {}}));
  card_.deaf = true;
  auto ended = std::async(std::launch::async, [this] { return daemon_.stop(SIGTERM); });
  ASSERT_TRUE(card_.serve_until_told(kSafe));
  card_.deaf = false;
  const auto lines = card_.heard.size();
  ASSERT_TRUE(card_.serve_until([&] { return card_.heard.size() > lines; })) << "the first line was lost";
  card_.serve_until([&] { return ended.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  EXPECT_EQ(ended.get(), 0);
}

TEST_F(MotorProcess, ASecondSignalEndsAtOnceWithAStatusThatSaysSo) {
  const auto note = daemon_.folder() / "log" / "motor.commanded";
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  ASSERT_EQ(pilot.order(500)["ok"], true);
  card_.deaf = true;
  ::kill(daemon_.pid(), SIGTERM);
  ASSERT_TRUE(card_.serve_until_told(kSafe));
  EXPECT_EQ(daemon_.stop(SIGTERM), 4);
  EXPECT_TRUE(std::filesystem::exists(note));
}

TEST_F(MotorProcess, StopStopsWhoeverIsInCharge) {
  Controller pilot(daemon_), page(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1000, kLong_s)["ok"], true);
  ASSERT_EQ(pilot.order(500)["ok"], true);
  ASSERT_TRUE(card_.serve_until_told({500, {}}));
  EXPECT_EQ(page.ask({{"command", "motor.stop"}, {"by", "page"}})["ok"], true);
  EXPECT_TRUE(card_.serve_until_told(kSafe));
  EXPECT_EQ(pilot.order(500)["error"], "stopped by page");
  auto answer = std::async(std::launch::async, [&] { return page.ask({{"command", "motor.stop"}, {"by", 7}}); });
  card_.serve_until([&] { return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  EXPECT_EQ(answer.get(), json::parse(R"({"ok":true,"shown":true})")) << "whatever the name is";
  card_.silent = true;
  EXPECT_EQ(page.ask({{"command", "motor.stop"}})["shown"], false);
}

TEST_F(MotorProcess, AStopDoesNotWaitForALeaseAndEndsOneThatWasAskedForBefore) {
  Controller pilot(daemon_), page(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  ASSERT_EQ(pilot.order(500)["ok"], true);
  page.client().send(
      "{\"command\":\"motor.lease\",\"holder\":\"page\",\"priority\":2}\n{\"command\":\"motor.stop\"}\n");
  EXPECT_EQ(json::parse(page.client().line().value())["error"], "stopped since the lease was asked for");
  EXPECT_EQ(json::parse(page.client().line().value())["ok"], true);
  EXPECT_TRUE(card_.serve_until_told(kSafe));
}

TEST_F(MotorProcess, ThousandsOfLeasesAtOnceAreAllAnswered) {
  // Each is answered by another thread than the loop's.
  constexpr int kControllers = 12, kLeases = 400;
  std::vector<std::future<int>> controllers;
  for (int i = 0; i < kControllers; ++i)
    controllers.push_back(std::async(std::launch::async, [this] {
      Controller controller(daemon_);
      int answers = 0;
      while (answers < kLeases && controller.lease("one of many", 1, kLong_s).contains("ok")) ++answers;
      return answers;
    }));
  for (auto& controller : controllers) EXPECT_EQ(controller.get(), kLeases);
  EXPECT_EQ(stop(), 0);
}

TEST_F(MotorProcess, IdleConnectionsLockNobodyOut) {
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  ASSERT_EQ(pilot.order(500)["ok"], true);
  std::vector<std::unique_ptr<Controller>> idle;
  for (int i = 0; i < 40; ++i) idle.push_back(std::make_unique<Controller>(daemon_));
  EXPECT_EQ(Controller(daemon_).ask({{"command", "status"}})["ok"], true);
  EXPECT_EQ(pilot.order(501)["ok"], true) << "who is in charge keeps its place";
  EXPECT_EQ(Controller(daemon_).ask({{"command", "motor.stop"}})["ok"], true);
  EXPECT_TRUE(card_.serve_until_told(kSafe));
}

TEST_F(MotorProcess, OrdersThatWaitedWhileNavcaldStoodStillAreVoid) {
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, 1)["ok"], true);
  ASSERT_EQ(pilot.order(500)["ok"], true);
  ::kill(daemon_.pid(), SIGSTOP);
  const json order{
      {"command", "motor.order"}, {"lease", pilot.token()}, {"shaft_rpm", 600}, {"fins_deg", {0, 0, 0}}};
  for (int i = 0; i < 3; ++i) pilot.client().send(order.dump() + "\n");
  ::usleep(1'500'000);
  ::kill(daemon_.pid(), SIGCONT);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(json::parse(pilot.client().line().value())["error"], "the lease expired: no order came for 1 s");
  EXPECT_TRUE(card_.serve_until_told(kSafe));
  for (const auto& heard : card_.heard) EXPECT_NE(heard.rpm, 600);
}

TEST_F(MotorProcess, AnOrderIsServedBeforeTheRequestsThatViewersHavePiledUp) {
  constexpr int kViewers = 20, kRequests = 100;
  std::string all;
  for (int i = 0; i < kRequests; ++i) all += "?VERSION;";
  std::vector<std::unique_ptr<Client>> viewers;
  for (int i = 0; i < kViewers; ++i) {
    viewers.push_back(std::make_unique<Client>(daemon_.port()));
    ASSERT_TRUE(viewers.back()->line());
    viewers.back()->send(all + "\n");
  }
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
  ASSERT_EQ(pilot.order(500)["ok"], true);
  EXPECT_TRUE(card_.serve_until_told({500, {}}));
  // Each gets all its answers, one after the other.
  for (int i = 0; i < 12; ++i) ASSERT_TRUE(viewers.back()->line());
}

/// The next start finds the note in the state folder when it finds nothing else.
class MotorProcessAfterAKill : public MotorProcess {
 protected:
  void leave_turning() {
    Controller pilot(daemon_);
    ASSERT_EQ(pilot.lease("pilot", 1, kLong_s)["ok"], true);
    ASSERT_EQ(pilot.order(500)["ok"], true);
    ASSERT_TRUE(card_.serve_until_told({500, {}}));
    daemon_.stop(SIGKILL);
  }
};

TEST_F(MotorProcessAfterAKill, TheSafeStateIsOrderedThoughTheLogFolderIsGone) {
  leave_turning();
  std::filesystem::remove_all(daemon_.folder() / "log");
  daemon_.start_again();
  EXPECT_TRUE(card_.serve_until_told(kSafe));
}

TEST_F(MotorProcessAfterAKill, TheSafeStateIsOrderedThoughNothingCanBeLogged) {
  leave_turning();
  std::filesystem::remove_all(daemon_.folder() / "log");
  std::ofstream(daemon_.folder() / "log") << "no folder any more";
  daemon_.start_again();
  EXPECT_TRUE(card_.serve_until_told(kSafe));
  Controller pilot(daemon_);
  json health;
  ASSERT_TRUE(card_.serve_until([&] { return !(health = pilot.health())["alarms"].empty(); }));
  EXPECT_EQ(health["alarms"][0]["alarm"], "log_failing");
  EXPECT_EQ(health["log"]["state"], "failing");
  EXPECT_NE(health["log"]["reason"].get<std::string>().find("log folder"), std::string::npos);
}

TEST_F(MotorProcessAfterAKill, TheSafeStateIsOrderedBeforeABadConfigurationEndsTheStart) {
  leave_turning();
  std::ofstream(daemon_.config()) << "[port.compass\n";
  daemon_.start_again();
  EXPECT_TRUE(card_.serve_until_told(kSafe));
  EXPECT_EQ(stop(0), 3) << daemon_.diagnostics();
  EXPECT_NE(daemon_.diagnostics().find("navcald.toml"), std::string::npos) << daemon_.diagnostics();
}

TEST_F(MotorProcess, StateIsPacedAndSaysWhoIsInChargeAndHowLateTheOrderCame) {
  Client watcher(daemon_.port());
  watcher.send("?WATCH={\"enable\":true,\"json\":true,\"classes\":[\"STATE\"],\"rate_Hz\":{\"STATE\":20}};\n");
  const json idle = json::parse(watcher.line_with("\"STATE\",\"time\""));
  EXPECT_TRUE(idle["motor"]["holder"].is_null());
  EXPECT_TRUE(idle["heading_rad"].is_null());
  EXPECT_TRUE(idle["shaft_rpm"].is_null());
  Controller pilot(daemon_);
  ASSERT_EQ(pilot.lease("pilot", 3, kLong_s)["ok"], true);
  const json state = json::parse(watcher.line_with("\"holder\":\"pilot\""));
  EXPECT_EQ(state["motor"]["priority"], 3);
  EXPECT_NEAR(state["motor"]["expires_in_s"].get<double>(), kLong_s, 50);
  ASSERT_EQ(pilot.order(120, {1, 0, 0}, state["time"])["ok"], true);
  ASSERT_TRUE(card_.serve_until([&] { return pilot.health()["motor"]["echoed"] == 1; }));
  json after;
  for (int i = 0; i < 1000 && after["shaft_rpm"] != 120; ++i)
    after = json::parse(watcher.line_with("\"sequence\":1"));
  ASSERT_EQ(after["shaft_rpm"], 120);
  EXPECT_GE(after["order"]["late_s"].get<double>(), 0);
  EXPECT_LT(after["order"]["late_s"].get<double>(), 60);
  EXPECT_EQ(after["fins_deg"], json::parse("[1,0,0]"));
  EXPECT_GE(after["age_s"]["motor"].get<double>(), 0);
}

TEST(MotorProcessWithoutCard, OrdersAreRefusedWithTheReason) {
  DaemonProcess nmea;
  nmea.wait_until_ready();
  EXPECT_EQ(Controller(nmea).lease("pilot", 1, 1)["error"], "the configuration has no motor card");
  DaemonProcess off({"--set", "port.compass.protocol=motor-card", "--set", "command.enabled=false"});
  off.wait_until_ready();
  EXPECT_EQ(Controller(off).lease("pilot", 1, 1)["error"], "orders are switched off (command.enabled)");
  DaemonProcess away(
      {"--set", "port.compass.protocol=motor-card", "--set", "port.compass.path=/dev/navcal-is-not-here"});
  away.wait_until_ready();
  Controller pilot(away);
  ASSERT_EQ(pilot.lease("pilot", 1, 5)["ok"], true);
  const std::string error = pilot.order(100)["error"];
  EXPECT_TRUE(error.starts_with("the motor card is away: ")) << error;
  EXPECT_GT(error.size(), 26U) << "and why";
}

}  // namespace
}  // namespace navcal::daemon
