// SPDX-License-Identifier: Apache-2.0
// Control and download of the log through a running navcald's control socket.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "record/json/base64.h"
#include "record/log/checksum.h"
#include "record/recording.h"
#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;

class LogProcess : public testing::Test {
 protected:
  void start(const std::vector<std::string>& more = {}) {
    daemon_ = std::make_unique<DaemonProcess>(more);
    daemon_->wait_until_ready();
    control_ = std::make_unique<Client>(daemon_->folder() / "control");
  }
  json ask(const json& request) {
    control_->send(request.dump() + "\n");
    return json::parse(control_->line().value());
  }
  json log_state() { return ask({{"command", "status"}})["health"][0]["log"]; }
  json files() { return ask({{"command", "log.list"}})["files"]; }
  template <class Condition>
  bool eventually(Condition condition) {
    for (int i = 0; i < 2000; ++i) {
      if (condition()) return true;
      ::usleep(5000);
    }
    return false;
  }
  bool wait_for_files(std::size_t finished, std::size_t open) {
    return eventually([&] {
      const json found = files();
      const auto done =
          std::count_if(found.begin(), found.end(), [](const json& log) { return log["finished"] == true; });
      return static_cast<std::size_t>(done) == finished && found.size() == finished + open;
    });
  }
  std::string download(const std::string& name, std::uint64_t step) {
    std::string bytes;
    for (;;) {
      const json part = ask({{"command", "log.read"}, {"file", name}, {"offset", bytes.size()}, {"length", step}});
      EXPECT_EQ(part["ok"], true) << part;
      EXPECT_EQ(part["offset"], bytes.size());
      const auto piece = record::from_base64(part["data"].get<std::string>());
      EXPECT_TRUE(piece);
      EXPECT_EQ(part["length"], piece->size());
      EXPECT_EQ(part["crc32"], record::crc32(*piece));
      if (piece->empty()) return bytes;
      bytes += *piece;
      EXPECT_LE(bytes.size(), part["size"].get<std::size_t>());
    }
  }
  static std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  /// What a log says: its remarks, and how many raw reads and events of each name it has.
  struct Content {
    std::vector<std::string> remarks;
    int raw = 0;
    std::string events;
  };
  static Content content_of(const std::filesystem::path& file) {
    Content content;
    const auto recording = record::Recording::open(file);
    while (auto entry = recording->next()) {
      if (std::holds_alternative<record::RawRead>(*entry)) ++content.raw;
      if (const auto* event = std::get_if<record::LoggedEvent>(&*entry))
        content.events += json::parse(event->json)["name"].get<std::string>() + " ";
    }
    content.remarks = recording->remarks();
    return content;
  }

  std::unique_ptr<DaemonProcess> daemon_;
  std::unique_ptr<Client> control_;
};

TEST_F(LogProcess, AStoppedLogIsWholeAndTheRestRunsOn) {
  start();
  daemon_->line.sentence("HCHDT,123.4,T");
  ASSERT_EQ(ask({{"command", "log.stop"}})["ok"], true);
  EXPECT_EQ(ask({{"command", "log.stop"}})["ok"], true) << "it is stopped already";
  ASSERT_TRUE(wait_for_files(1, 0));
  EXPECT_EQ(log_state()["state"], "stopped");
  EXPECT_TRUE(eventually([&] { return log_state()["file"] == ""; }));
  EXPECT_EQ(ask({{"command", "log.rotate"}})["error"], "the log is stopped (log.start)");
  // It still reads and serves.
  Client status(daemon_->port());
  status.send("?WATCH={\"enable\":true,\"json\":true};\n");
  ASSERT_FALSE(status.line_with("\"WATCH\"").empty());
  daemon_->line.sentence("HCHDT,124.4,T");
  EXPECT_FALSE(status.line_with("\"ATT\"").empty());
  ASSERT_EQ(daemon_->logs().size(), 1U);
  const auto content = content_of(daemon_->logs().front());
  EXPECT_TRUE(content.remarks.empty()) << content.remarks.front();
  EXPECT_NE(content.events.find("log.stop"), std::string::npos);

  ASSERT_EQ(ask({{"command", "log.start"}})["ok"], true);
  ASSERT_TRUE(wait_for_files(1, 1));
  EXPECT_EQ(log_state()["state"], "writing");
  ASSERT_EQ(ask({{"command", "log.stop"}})["ok"], true);
  EXPECT_EQ(daemon_->stop(SIGTERM), 0) << daemon_->diagnostics();
  for (const auto& file : daemon_->logs()) EXPECT_TRUE(content_of(file).remarks.empty()) << file;
  daemon_->start_again();
  daemon_->wait_until_ready();
  control_ = std::make_unique<Client>(daemon_->folder() / "control");
  EXPECT_EQ(log_state()["state"], "writing") << "the configuration decides after a restart";
}

TEST_F(LogProcess, WhatIsLeftOutIsMissingAndTheLogSaysSo) {
  start({"--set", "log.leave_out=[\"raw.compass\"]"});
  daemon_->line.sentence("HCHDT,123.4,T");
  ASSERT_TRUE(eventually([&] { return ask({{"command", "status"}})["health"][0]["ports"][0]["samples"] == 1; }));
  EXPECT_EQ(ask({{"command", "log.select"}})["leave_out"], json({"raw.compass"}));
  EXPECT_EQ(ask({{"command", "log.select"}, {"leave_out", {"raw.imu"}}})["error"], "there is no port imu");
  EXPECT_NE(ask({{"command", "log.select"}, {"leave_out", {"events"}}})["ok"], true);
  ASSERT_EQ(ask({{"command", "log.select"}, {"leave_out", json::array()}})["ok"], true);
  daemon_->line.sentence("HCHDT,125.4,T");
  ASSERT_TRUE(eventually([&] { return ask({{"command", "status"}})["health"][0]["ports"][0]["samples"] == 2; }));
  ASSERT_EQ(daemon_->stop(SIGTERM), 0);
  const auto content = content_of(daemon_->logs().front());
  EXPECT_EQ(content.raw, 1);
  ASSERT_EQ(content.remarks.size(), 1U);
  EXPECT_NE(content.remarks.front().find("left out of this log by log.leave_out or log.select: raw.compass"),
            std::string::npos)
      << content.remarks.front();
}

TEST_F(LogProcess, ADownloadIsTheFileBitByBit) {
  start();
  for (int i = 0; i < 20; ++i) daemon_->line.sentence("HCHDT,123.4,T");
  ASSERT_EQ(ask({{"command", "log.rotate"}})["ok"], true);
  ASSERT_TRUE(wait_for_files(1, 1));
  const json list = files();
  EXPECT_EQ(list[0]["finished"], true);
  EXPECT_EQ(list[1]["finished"], false);
  EXPECT_LE(list[0]["begin"].get<std::string>(), list[0]["end"].get<std::string>());
  EXPECT_EQ(list[1]["end"], nullptr);
  const std::string name = list[0]["name"];
  const std::string whole = contents(daemon_->folder() / "log" / name);
  EXPECT_EQ(list[0]["bytes"], whole.size());
  EXPECT_EQ(download(name, 65536), whole);
  EXPECT_EQ(download(name, 1001), whole);
  const json sum = ask({{"command", "log.sum"}, {"file", name}, {"offset", 10}, {"length", 1 << 24}});
  EXPECT_EQ(sum["crc32"], record::crc32(std::string_view(whole).substr(10)));
  EXPECT_EQ(sum["length"], whole.size() - 10);
  EXPECT_FALSE(sum.contains("data"));
  // One page after the other.
  const json first = ask({{"command", "log.list"}, {"limit", 1}});
  EXPECT_EQ(first["more"], true);
  const json second = ask({{"command", "log.list"}, {"after", name}});
  EXPECT_EQ(second["files"][0]["name"], list[1]["name"]);
  EXPECT_EQ(second["more"], false);
}

TEST_F(LogProcess, NamesThatAreNotLogsAndPlacesThatAreNotThereAreRefused) {
  start();
  ASSERT_TRUE(eventually([&] { return log_state()["bytes"] > 1000; }));
  const std::string name = daemon_->logs().front().filename();
  const auto folder = daemon_->folder() / "log";
  const std::string link = "navcal-20261121T023000Z-999999.mcap";
  std::filesystem::create_symlink("/etc/passwd", folder / link);
  const auto read = [&](const std::string& file, std::uint64_t offset = 0) {
    const json answer = ask({{"command", "log.read"}, {"file", file}, {"offset", offset}, {"length", 100}});
    EXPECT_EQ(answer["ok"], answer.contains("data"));
    return answer.value("error", "");
  };
  const std::string no_log = "that is not the name of a log; log.list has them";
  for (const std::string bad :
       {"../navcald.toml", "/etc/passwd", "..", ".", "navcal.lock", "navcal-../../../etc/pas-000001.mcap",
        "navcal-20261121T023000Z-00001.mcap", "navcal-20261121T023000Z-000001.mcap/../x", "\n",
        "navcal-20261121T023000Z-0000x1.mcap"})
    EXPECT_EQ(read(bad), no_log) << bad;
  EXPECT_EQ(read(std::string("navcal-20261121T023000Z-000001.mcap\0", 36)), no_log);
  EXPECT_NE(read(link), "") << "through a link";
  EXPECT_NE(read("navcal-20261121T023000Z-000777.mcap").find("there is no such log"), std::string::npos);
  EXPECT_NE(read(name, 1ULL << 60).find("is behind its end"), std::string::npos);
  EXPECT_EQ(read(name, 0), "");
  for (const json& log : files()) EXPECT_NE(log["name"], link);
  // A client that asks much in one go gets every answer, in order.
  std::string many;
  for (int i = 0; i < 10; ++i)
    many += json{{"command", "log.read"}, {"file", name}, {"offset", i}, {"length", 1}}.dump() + "\n";
  control_->send(many);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(json::parse(control_->line().value())["offset"], i);
}

TEST_F(LogProcess, WithoutALogNothingIsStartedAndWithoutSuppliesNothingIsSwitched) {
  start({"--set", "log.enabled=false"});
  for (const char* command : {"log.start", "log.stop", "log.select", "log.rotate"})
    EXPECT_EQ(ask({{"command", command}})["error"], "the log is disabled (log.enabled)") << command;
  EXPECT_EQ(ask({{"command", "power.list"}})["supplies"], json::array());
  EXPECT_EQ(ask({{"command", "power.on"}, {"name", "mast"}})["error"],
            "there is no supply mast; power.list has them");
}

}  // namespace
}  // namespace navcal::daemon
