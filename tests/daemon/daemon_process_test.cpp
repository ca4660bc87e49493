// SPDX-License-Identifier: Apache-2.0
// The service as it is installed: a process, a pseudo-terminal, sockets, a log on disk.
#include "tests/daemon/daemon_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "config/load.h"
#include "record/byte_source.h"
#include "record/log/log_encoder.h"
#include "record/log/log_reader.h"
#include "record/recording.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;

std::unique_ptr<Client> watcher(const DaemonProcess& daemon) {
  daemon.wait_until_ready();
  auto client = std::make_unique<Client>(daemon.port());
  client->send("?WATCH={\"enable\":true,\"json\":true};\n");
  client->line_with("\"class\":\"WATCH\"");
  return client;
}

/// Waits until the port is open: what is written to a pseudo-terminal before that is lost.
void wait_until_open(Client& client) { client.line_with("\"state\":\"running\""); }

TEST(DaemonProcess, WhatTheDeviceSaysIsServedAndLoggedByteForByte) {
  DaemonProcess daemon;
  const auto client = watcher(daemon);
  wait_until_open(*client);
  for (int heading = 100; heading < 150; ++heading) {
    daemon.line.sentence("HCHDM," + std::to_string(heading) + ".5,M");
    const json att = json::parse(client->line_with("\"class\":\"ATT\""));
    EXPECT_EQ(att["device"], "compass");
    EXPECT_EQ(att["heading"], heading + 0.5);
  }
  ASSERT_EQ(daemon.stop(SIGTERM), 0) << daemon.diagnostics();
  ASSERT_EQ(daemon.logs().size(), 1U);
  const auto recording = record::Recording::open(daemon.logs()[0]);
  std::string received;
  while (auto entry = recording->next()) {
    const auto* raw = std::get_if<record::RawRead>(&*entry);
    if (raw != nullptr && raw->direction == record::Direction::received) {
      received.append(raw->bytes.begin(), raw->bytes.end());
    }
  }
  EXPECT_EQ(std::count(received.begin(), received.end(), '\n'), 50);
  EXPECT_NE(received.find("$HCHDM,149.5,M*"), std::string::npos);
  EXPECT_TRUE(recording->remarks().empty()) << "the log was finished";
}

TEST(DaemonProcess, ASecondDaemonIsToldWhatIsTaken) {
  DaemonProcess daemon;
  const auto client = watcher(daemon);
  {
    const auto [status, said] = daemon.run_another({});
    EXPECT_EQ(status, 1);
    EXPECT_NE(said.find("is taken"), std::string::npos) << said;
  }
  {
    const auto [status, said] = daemon.run_another({"--set", "status.port=0"});
    EXPECT_EQ(status, 1);
    EXPECT_NE(said.find("another navcald answers there"), std::string::npos) << said;
  }
  EXPECT_EQ(daemon.logs().size(), 1U) << "a daemon that cannot start leaves no log";
}

TEST(DaemonProcess, ASecondDaemonLogsInAFolderAsSoonAsTheFirstHasLeftIt) {
  auto first = std::make_unique<DaemonProcess>();
  first->wait_until_ready();
  const DaemonProcess second({"--set", "log.directory=" + (first->folder() / "log").string()});
  second.wait_until_ready();
  Client control(second.folder() / "control");
  const auto health_until = [&](std::string_view words) {
    for (int i = 0; i < 4000; ++i) {
      control.send("{\"command\":\"status\"}\n");
      if (const auto line = control.line(); line && line->find(words) != std::string::npos) return true;
      ::usleep(5000);
    }
    return false;
  };
  EXPECT_TRUE(health_until("another navcald is writing logs there"));
  EXPECT_TRUE(health_until("\"alarm\":\"log_failing\""));
  EXPECT_EQ(first->logs().size(), 1U);
  EXPECT_EQ(first->stop(SIGTERM), 0);
  EXPECT_TRUE(health_until("\"alarms\":[]"));
  EXPECT_EQ(first->logs().size(), 2U);
}

TEST(DaemonProcess, BadConfigurationAndUsageHaveTheirStatuses) {
  DaemonProcess daemon;
  EXPECT_EQ(daemon.run_another({"--set", "status.prot=1"}).first, 3);
  EXPECT_EQ(daemon.run_another({"--nonsense"}).first, 2);
  EXPECT_EQ(daemon.run_another({"--check"}).first, 0);
}

TEST(DaemonProcess, TheControlSocketMarksRotatesAndRefuses) {
  DaemonProcess daemon;
  daemon.wait_until_ready();
  Client control(daemon.folder() / "control");
  const auto ask = [&](const std::string& line) {
    control.send(line + "\n");
    return json::parse(control.line().value());
  };
  EXPECT_EQ(ask(R"({"command":"event","text":"dive 3"})")["ok"], true);
  EXPECT_EQ(ask(R"({"command":"log.rotate"})")["ok"], true);
  // An NMEA compass alone: there is no gyro to calibrate it by.
  EXPECT_EQ(ask(R"({"command":"calibration.accept","calibrator":"compass"})")["error"],
            "the configuration has no instruments for it");
  EXPECT_NE(ask(R"({"command":"calibration.accept","calibrator":"sextant"})")["error"].get<std::string>().find(
                "must be one of gyro, gyro_b, compass"),
            std::string::npos);
  EXPECT_EQ(ask("nonsense")["ok"], false);
  const json status = ask(R"({"command":"status"})");
  EXPECT_EQ(status["health"][0]["ports"][0]["device"], "compass");
  EXPECT_EQ(daemon.stop(SIGINT), 0);
  EXPECT_EQ(daemon.logs().size(), 2U);
  EXPECT_FALSE(std::filesystem::exists(daemon.folder() / "control"));
}

TEST(DaemonProcess, APortThatIsNotThereIsSaidAndNothingElseSuffers) {
  DaemonProcess daemon({"--set", "port.compass.path=/dev/navcal-is-not-here"});
  const auto client = watcher(daemon);
  const json health = json::parse(client->line_with("HEALTH"));
  EXPECT_EQ(health["ports"][0]["state"], "away");
  EXPECT_FALSE(health["ports"][0]["reason"].get<std::string>().empty());
  EXPECT_EQ(health["log"]["state"], "writing");
  EXPECT_EQ(health["ports"][0]["latency_sum_s"], 0);
  EXPECT_GT(health["process"]["cpu_s"].get<double>(), 0);
  EXPECT_GT(health["process"]["most_resident_kB"].get<int>(), 1000);
  EXPECT_TRUE(health["process"]["version"].is_string());
  EXPECT_TRUE(health["utc"]["source"].is_string());
  EXPECT_TRUE(health["utc"].contains("bound_s"));
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
}

TEST(DaemonProcess, APortWhoseSentencesHaveNoDecoderNamesThem) {
  DaemonProcess daemon;
  const auto client = watcher(daemon);
  wait_until_open(*client);
  for (int i = 0; i < 5; ++i) daemon.line.sentence("PXYZA,1,2");
  json port;
  do {
    port = json::parse(client->line_with("HEALTH"))["ports"][0];
  } while (port["unused"] < 5);
  EXPECT_EQ(port["unused_kinds"], "PXYZA 5");
  EXPECT_EQ(port["samples"], 0);
  do {
    daemon.line.sentence("PXYZA,1,2");  // a silent port has another reason
    port = json::parse(client->line_with("HEALTH"))["ports"][0];
  } while (port["reason"].get<std::string>().find("frames give no sample: PXYZA ") == std::string::npos);
  EXPECT_EQ(port["state"], "running");
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
}

TEST(DaemonProcess, AFixMakesHeadingsTrueAndHealthSaysWhoServesWhat) {
  DaemonProcess daemon;
  const auto client = watcher(daemon);
  wait_until_open(*client);
  daemon.line.sentence("HCHDM,100.5,M");
  const json before = json::parse(client->line_with("\"class\":\"ATT\""));
  EXPECT_EQ(before["heading"], 100.5);
  EXPECT_EQ(before["north"], "magnetic");
  // Stockholm, where the declination is some 8 degrees east.
  daemon.line.sentence("GPRMC,120000.00,A,5920.0000,N,01804.0000,E,1.0,010.0,230626,,,A");
  EXPECT_EQ(json::parse(client->line_with("\"class\":\"TPV\""))["mode"], 2);
  daemon.line.sentence("HCHDM,100.5,M");
  const json after = json::parse(client->line_with("\"class\":\"ATT\""));
  EXPECT_NEAR(after["heading"].get<double>(), 108.5, 1);
  EXPECT_EQ(after["north"], "true");
  json health;
  do {
    health = json::parse(client->line_with("HEALTH"));
  } while (!health["sources"].contains("position"));
  EXPECT_EQ(health["sources"]["heading"], "compass");
  EXPECT_EQ(health["sources"]["position"], "compass");
  EXPECT_FALSE(health["sources"].contains("rates"));
  EXPECT_EQ(health["earth_field"]["declination_source"], "model");
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
  EXPECT_NE(daemon.diagnostics().find("earth_field: declination"), std::string::npos) << daemon.diagnostics();
}

TEST(DaemonProcess, HealthAndLogSayWhichVehicleThisIs) {
  DaemonProcess daemon({"--set", "vehicle.id=auv-7", "--set", "vehicle.name=Tümmler", "--set",
                        "port.compass.serial_number=40-113"});
  const auto client = watcher(daemon);
  const json health = json::parse(client->line_with("HEALTH"));
  EXPECT_EQ(health["vehicle"]["id"], "auv-7");
  EXPECT_EQ(health["vehicle"]["name"], "Tümmler");
  EXPECT_EQ(health["ports"][0]["serial_number"], "40-113");
  ASSERT_EQ(daemon.stop(SIGTERM), 0) << daemon.diagnostics();
  record::LogReader log(record::open_file(daemon.logs()[0]), "log");
  while (const auto message = log.next()) {
    if (log.channels().at(message->channel).topic != "/config") continue;
    const std::string toml = json::parse(message->data)["toml"];
    EXPECT_EQ(health["vehicle"]["config_crc32c"], record::config_sum(toml));
    EXPECT_EQ(config::parse(toml, "log").vehicle.name, "Tümmler");
  }
  EXPECT_EQ(log.metadata().at("vehicle_id"), "auv-7");
  EXPECT_EQ(log.metadata().at("vehicle_name"), "Tümmler");
  EXPECT_EQ(health["vehicle"]["config_crc32c"], log.metadata().at("config_crc32c"));
  const auto raw = std::find_if(log.channels().begin(), log.channels().end(),
                                [](const auto& channel) { return channel.second.raw; });
  ASSERT_NE(raw, log.channels().end());
  EXPECT_EQ(raw->second.metadata.at("serial_number"), "40-113");
}

TEST(DaemonProcess, CheckRefusesRolesThatNobodyCanFill) {
  DaemonProcess daemon;
  daemon.wait_until_ready();  // before that SIGTERM ends it like any process
  const auto [status, why] = daemon.run_another({"--check", "--set", "roles.depth=compass"});
  EXPECT_EQ(status, 3);
  EXPECT_NE(why.find("--set: roles.depth: port compass is of protocol nmea, which has no depth"),
            std::string::npos)
      << why;
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
}

// A pager that is not scrolled, a journal that stands still: with messages written by the loop itself all ports
// stood still with them.
TEST(DaemonProcess, AStandardErrorThatNobodyReadsHoldsNothingUp) {
  const test::TemporaryFolder folder;
  const std::string pipe = folder.path() / "unread";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int descriptor = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(descriptor, 0);
  const std::string filling(4096, '.');
  while (::write(descriptor, filling.data(), filling.size()) > 0) continue;

  DaemonProcess daemon({}, pipe);
  const auto client = watcher(daemon);
  wait_until_open(*client);
  daemon.line.sentence("HCHDM,100.5,M");
  EXPECT_EQ(json::parse(client->line_with("\"class\":\"ATT\""))["heading"], 100.5);

  std::string said(1 << 20, '\0');
  EXPECT_GT(::read(descriptor, said.data(), said.size()), 0);
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
  const ssize_t size = ::read(descriptor, said.data(), said.size());
  said.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  EXPECT_NE(said.find("SIGTERM"), std::string::npos) << "heard again: " << said;
  ::close(descriptor);
}

TEST(DaemonProcess, HangupBeginsANewLog) {
  DaemonProcess daemon;
  daemon.wait_until_ready();
  ::kill(daemon.pid(), SIGHUP);
  Client control(daemon.folder() / "control");
  for (int i = 0; i < 2000 && daemon.logs().size() < 2; ++i) ::usleep(5000);
  EXPECT_EQ(daemon.logs().size(), 2U);
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
}

TEST(DaemonProcess, NobodyForgesALineOfItsMessages) {
  DaemonProcess daemon;
  daemon.wait_until_ready();
  Client control(daemon.folder() / "control");
  control.send(R"({"command":"event","text":"x\n00:00:00.000 critical motor\u001b]0;OWNED\u0007"})"
               "\n");
  ASSERT_NE(control.line_with("ok"), "");
  ASSERT_EQ(daemon.stop(SIGTERM), 0);
  const std::string messages = daemon.diagnostics();
  EXPECT_NE(messages.find("x\\u000a00:00:00.000 critical motor\\u001b]0;OWNED\\u0007\n"), std::string::npos)
      << messages;
  EXPECT_EQ(messages.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace navcal::daemon
