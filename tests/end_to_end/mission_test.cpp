// SPDX-License-Identifier: Apache-2.0
// The product as its user has it: emulated instruments on pseudo-terminals, navcald reading them, then the tools
// on its log. What was sent is what was logged, byte for byte; replay gives the samples that were live.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "record/capture/capture_reader.h"
#include "record/log/log_reader.h"
#include "record/recording.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

using test::eventually;
using test::Process;
using test::TemporaryFolder;

constexpr std::chrono::seconds kMissionPatience{60};

constexpr std::array kTopics{"/compass", "/imu", "/gps", "/motor", "/nav"};

struct Traffic {
  std::map<std::string, std::string> received, sent;  // by port
};

Traffic traffic_of(const std::filesystem::path& file) {
  Traffic traffic;
  const auto recording = record::Recording::open(file);
  const auto& ports = recording->settings().ports;
  while (const auto entry = recording->next()) {
    if (const auto* raw = std::get_if<record::RawRead>(&*entry)) {
      auto& side = raw->direction == record::Direction::received ? traffic.received : traffic.sent;
      side[ports.at(raw->port).name].append(raw->bytes.begin(), raw->bytes.end());
    }
  }
  return traffic;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Emulated instruments and a daemon that reads them for a few seconds, both stopped as a user stops them.
class Mission : public testing::Test {
 protected:
  void SetUp() override {
    Process instruments({NAVCAL_PROGRAM, "emulate", "--dir", ports_.string(), "--seed", "5", "--sent-log",
                         (folder_ / "sent.cap").string()},
                        folder_ / "emulate");
    ASSERT_TRUE(eventually([&] { return instruments.out().find("ready") != std::string::npos; }))
        << instruments.err();
    Process daemon(daemon_command(), folder_ / "navcald");
    ASSERT_TRUE(eventually([&] { return every_instrument_is_logged(); }, kMissionPatience)) << daemon.err();
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait(kMissionPatience), 0) << daemon.err();
    instruments.signal(SIGTERM);
    EXPECT_EQ(instruments.wait(kMissionPatience), 0) << instruments.err();
    for (const auto& entry : std::filesystem::directory_iterator(logs_)) {
      if (entry.path().extension() == ".mcap") log_ = entry.path();
    }
    ASSERT_FALSE(log_.empty());
  }

  std::vector<std::string> daemon_command() {
    std::filesystem::create_directories(logs_);
    std::vector<std::string> command{NAVCALD, "--config", NAVCAL_SOURCE_DIR "/config/navcald.toml"};
    const auto set = [&](const std::string& key, const std::string& value) {
      command.insert(command.end(), {"--set", key + "=" + value});
    };
    for (const std::string port : {"compass", "imu", "gps", "motor"})
      set("port." + port + ".path", (ports_ / port).string());
    set("log.directory", logs_.string());
    set("control.socket", (folder_ / "control").string());
    set("status.port", "0");
    return command;
  }

  /// Whether the log, still growing, holds several samples of each instrument. Its size would not say: the
  /// settings and schemas at its beginning have grown with every version.
  [[nodiscard]] bool every_instrument_is_logged() const {
    std::map<std::string, int> samples;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(logs_, ignored)) {
      if (entry.path().extension() != ".mcap") continue;
      try {
        record::LogReader reader(record::open_file(entry.path()), entry.path().string());
        while (const auto message = reader.next()) ++samples[reader.channels().at(message->channel).topic];
      } catch (const record::BadRecording&) {
        return false;  // just made: its head is not written yet
      }
    }
    return std::all_of(kTopics.begin(), kTopics.end(), [&](const char* topic) { return samples[topic] > 1; });
  }

  TemporaryFolder folder_;
  std::filesystem::path ports_ = folder_ / "ports", logs_ = folder_ / "logs";
  std::filesystem::path log_;
};

TEST_F(Mission, WhatWasSentIsWhatWasLoggedAndReplayIsWhatWasLive) {
  const Traffic sent = traffic_of(folder_ / "sent.cap");
  const Traffic logged = traffic_of(log_);
  for (const std::string port : {"compass", "imu", "gps", "motor"}) {
    ASSERT_TRUE(logged.received.contains(port)) << port;
    const std::string& bytes = logged.received.at(port);
    // The instruments ran before and after the daemon did: its bytes are one unbroken piece of theirs.
    EXPECT_NE(sent.received.at(port).find(bytes), std::string::npos) << port << ": " << bytes.size() << " bytes";
    EXPECT_GT(bytes.size(), 100U) << port;
  }
  EXPECT_EQ(logged.sent, sent.sent);
  EXPECT_NE(logged.sent.at("compass").find("go\r"), std::string::npos);

  // Samples as they were written live, by topic, without the checksum that ends each.
  std::map<std::string, std::vector<std::string>> live;
  record::LogReader reader(record::open_file(log_), log_.string());
  while (const auto message = reader.next()) {
    const auto& channel = reader.channels().at(message->channel);
    if (channel.raw) continue;
    live[channel.topic].push_back(std::string(message->data.substr(0, message->data.rfind(",\"crc\":"))) + "}");
  }
  EXPECT_TRUE(reader.findings().finished);
  EXPECT_EQ(reader.findings().bad_crc, 0U);

  Process replay({NAVCAL_PROGRAM, "replay", log_.string()}, folder_ / "replay");
  ASSERT_EQ(replay.wait(kMissionPatience), 0) << replay.err();
  std::map<std::string, std::vector<std::string>> replayed;
  for (const auto& line : lines_of(replay.out())) {
    auto topic = "/" + nlohmann::json::parse(line).at("class").get<std::string>();
    for (char& c : topic) c = static_cast<char>(std::tolower(c));
    replayed[topic].push_back(line);
  }
  for (const std::string topic : kTopics) {
    EXPECT_GT(live[topic].size(), 0U) << topic;
    EXPECT_EQ(live[topic], replayed[topic]) << topic;
  }
}

TEST_F(Mission, TheLogExportsToTheFormsThatOthersRead) {
  Process info({NAVCAL_PROGRAM, "log", "info", "--json", log_.string()}, folder_ / "info");
  ASSERT_EQ(info.wait(kMissionPatience), 0) << info.err();
  EXPECT_TRUE(nlohmann::json::accept(info.out())) << info.out();

  const auto capture = folder_ / "again.cap";
  Process cap({NAVCAL_PROGRAM, "log", "export", "--cap", capture.string(), log_.string()}, folder_ / "cap");
  ASSERT_EQ(cap.wait(kMissionPatience), 0) << cap.err();
  const Traffic exported = traffic_of(capture), logged = traffic_of(log_);
  EXPECT_EQ(exported.received, logged.received);
  EXPECT_EQ(exported.sent, logged.sent);

  Process csv({NAVCAL_PROGRAM, "log", "export", "--csv", (folder_ / "csv").string(), log_.string()},
              folder_ / "csvout");
  ASSERT_EQ(csv.wait(kMissionPatience), 0) << csv.err();
  std::size_t tables = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "csv")) {
    if (entry.path().extension() != ".csv") continue;  // the configuration lies beside the tables
    ++tables;
    const auto rows = lines_of(test::read_file(entry.path()));
    ASSERT_FALSE(rows.empty());
    const auto columns = std::count(rows[0].begin(), rows[0].end(), ',');
    EXPECT_EQ(rows[0].substr(0, 4), "time") << entry.path();
    EXPECT_GT(columns, 0) << entry.path();
  }
  EXPECT_GE(tables, 4U);
}

}  // namespace
}  // namespace navcal
