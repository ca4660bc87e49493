// SPDX-License-Identifier: Apache-2.0
// RECORD of a running navcald against its log.
#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <nlohmann/json.hpp>

#include "record/log/log_messages.h"
#include "record/log/log_reader.h"
#include "tests/daemon/daemon_process.h"
#include "tests/support/process.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;

/// Topic and payload.
using Records = std::vector<std::pair<std::string, std::string>>;

/// The message in a line RECORD, byte for byte.
std::string message_of(const std::string& line) {
  const std::string key = ",\"message\":";
  const auto begin = line.find(key) + key.size();
  return line.substr(begin, line.rfind('}') - begin);
}

json tell(const DaemonProcess& daemon, const json& command) {
  Client control(daemon.folder() / "control");
  control.send(command.dump() + "\n");
  return json::parse(control.line().value());
}

void mark(const DaemonProcess& daemon, const std::string& text) {
  ASSERT_EQ(tell(daemon, {{"command", "event"}, {"text", text}})["ok"], true);
}

/// Everything between the marks "begin" and "end", with both.
Records between_marks(const Records& all) {
  Records found;
  bool inside = false;
  for (const auto& entry : all) {
    const bool event = entry.first == "/event";
    inside = inside || (event && entry.second.find("\"message\":\"begin\"") != std::string::npos);
    if (inside) found.push_back(entry);
    if (event && entry.second.find("\"message\":\"end\"") != std::string::npos) break;
  }
  return found;
}

/// An emulated vehicle with battery and altimeter, and a navcald on its lines.
struct EmulatedInstruments {
  EmulatedInstruments() {
    if (!test::eventually([&] { return emulator.out().find("ready") != std::string::npos; }))
      throw std::runtime_error(emulator.err());
  }
  [[nodiscard]] std::string path(const std::string& port) const { return (folder / "ports" / port).string(); }
  [[nodiscard]] std::string ports() const {
    const auto port = [&](const std::string& name, const std::string& protocol) {
      return "[port." + name + "]\nprotocol = \"" + protocol + "\"\npath = \"" + path(name) + "\"\n";
    };
    return port("imu", "imu-card") + port("gps", "nmea") + "baud = 9600\n" + port("motor", "motor-card") +
           port("battery", "nmea") + port("altimeter", "nmea");
  }
  test::TemporaryFolder folder;
  test::Process emulator{{NAVCAL_PROGRAM, "emulate", "--dir", (folder / "ports").string(), "--gps", "nmea",
                          "--battery", "3", "--floor-depth", "30"},
                         folder / "emulate"};
};

TEST(RecordProcess, EveryMessageIsThatOfTheLogToTheByte) {
  const EmulatedInstruments vehicle;
  DaemonProcess daemon({"--set", "port.compass.protocol=tcm2", "--set", "port.compass.baud=38400", "--set",
                        "port.compass.path=" + vehicle.path("compass"), "--set", "status.health_interval_s=0.5",
                        "--set", "battery.enabled=true", "--set", "navigation.interval_s=0.1"},
                       {}, vehicle.ports());
  daemon.wait_until_ready();
  Client client(daemon.port());
  client.send(R"(?WATCH={"enable":true,"json":true,"classes":["RECORD"]};)");
  client.line_with("\"WATCH\"");
  mark(daemon, "begin");
  ASSERT_EQ(tell(daemon, {{"command", "calibration.start"}, {"calibrator", "gyro"}})["ok"], true);
  Records sent;
  std::map<std::string, int> count;
  bool marked = false;
  for (int lines = 0; lines < 20'000; ++lines) {
    const std::string line = client.line().value();
    const json record = json::parse(line);
    ASSERT_EQ(record["class"], "RECORD") << line;
    sent.emplace_back(record["topic"], message_of(line));
    const json& message = record["message"];
    EXPECT_EQ(json::parse(sent.back().second), message);
    if (message["time"].is_number()) {
      EXPECT_EQ(message["time"], record["time"]) << line;
    }
    if (message.contains("device")) {
      EXPECT_EQ(message["device"], record["device"]) << line;
    }
    ++count[record["topic"]];
    const bool enough = count["/nav"] >= 40 && count["/gps"] >= 3 && count["/battery"] >= 3 &&
                        count["/motor"] >= 3 && count["/altimeter"] >= 3 && count["/health"] >= 3 &&
                        count["/calib"] >= 1;
    if (enough && !marked) mark(daemon, "end");
    marked = marked || enough;
    if (message.value("message", "") == "end") break;
  }
  EXPECT_EQ(daemon.stop(SIGTERM), 0);

  Records logged;
  const auto files = daemon.logs();
  ASSERT_EQ(files.size(), 1U);
  record::LogReader reader(record::open_file(files[0]), files[0].string());
  while (const auto message = reader.next()) {
    const auto& channel = reader.channels().at(message->channel);
    if (!channel.raw) logged.emplace_back(channel.topic, message->data);
  }
  const Records expected = between_marks(logged), found = between_marks(sent);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], expected[i]) << "message " << i;
  for (const char* topic :
       {"/compass", "/imu", "/gps", "/motor", "/power", "/battery", "/altimeter", "/nav", "/calib"})
    EXPECT_GT(count[topic], 0) << topic;
}

/// The next message on /compass, which must have its checksum.
json compass_message(const DaemonProcess& daemon, Client& client) {
  daemon.line.sentence("HCHDM,123.4,M");
  const std::string message = message_of(client.line_with("\"topic\":\"/compass\""));
  std::string again = message.substr(0, message.rfind(",\"crc\"")) + "}";
  record::append_sum(again, 0);
  EXPECT_EQ(again, message);
  return json::parse(message);
}

TEST(RecordProcess, NeedsNoLog) {
  DaemonProcess disabled({"--set", "log.enabled=false"});
  disabled.wait_until_ready();
  Client client(disabled.port());
  client.send(R"(?WATCH={"json":true,"classes":["RECORD"],"topics":["/compass","/event"]};)");
  client.line_with("\"WATCH\"");
  EXPECT_NEAR(compass_message(disabled, client)["heading_rad"].get<double>(), 123.4 * 3.14159265358979 / 180,
              1e-9);
  mark(disabled, "a mark");
  EXPECT_EQ(json::parse(client.line_with("\"a mark\""))["device"], nullptr);
}

TEST(RecordProcess, GoesOnWhileTheLogIsStoppedOrLeavesItOut) {
  DaemonProcess daemon({"--set", "log.leave_out=[\"samples\"]"});
  daemon.wait_until_ready();
  Client client(daemon.port());
  client.send(R"(?WATCH={"json":true,"classes":["RECORD"],"topics":["/compass"]};)");
  client.line_with("\"WATCH\"");
  EXPECT_EQ(compass_message(daemon, client)["device"], "compass");
  ASSERT_EQ(tell(daemon, {{"command", "log.stop"}})["ok"], true);
  EXPECT_EQ(compass_message(daemon, client)["device"], "compass");
}

}  // namespace
}  // namespace navcal::daemon
