// SPDX-License-Identifier: Apache-2.0
#include "daemon/status_server.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <future>
#include <nlohmann/json.hpp>
#include <thread>

#include "daemon/gpsd_replies.h"
#include "daemon/listeners.h"
#include "daemon/start_error.h"
#include "record/log/log_topics.h"
#include "tests/daemon/tcp_client.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;

class TwoDevices : public StatusSource {
 public:
  std::uint16_t device_count() const override { return 2; }
  std::optional<std::uint16_t> device_named(std::string_view name) const override {
    if (name == "compass") return 0;
    return name == "gps" ? std::optional<std::uint16_t>(1) : std::nullopt;
  }
  std::string_view device_name(std::uint16_t port) const override { return port == 0 ? "compass" : "gps"; }
  void append_device(std::string& out, std::uint16_t port) const override {
    append_device_object(out, {device_name(port), "nmea", "", 9600, 0, port == 1, std::nullopt});
  }
  void append_poll(std::string& out) const override { out += "{\"class\":\"POLL\",\"tpv\":[],\"sky\":[]}\n"; }
  void on_watch_changed() override { ++watch_changes; }
  int watch_changes = 0;
};

/// The server on its own thread, as the daemon runs it.
class StatusServerTest : public ::testing::Test {
 protected:
  static config::StatusSettings settings() {
    config::StatusSettings settings;
    settings.port = 0;
    settings.max_clients = 3;
    settings.client_queue_bytes = 64 << 10;
    return settings;
  }

  template <class Action>
  auto on_loop(Action action) {
    std::packaged_task<decltype(action())()> task(std::move(action));
    auto result = task.get_future();
    boost::asio::post(context_, [&task] { task(); });
    return result.get();
  }

  void SetUp() override {
    server_.start();
    thread_ = std::thread([this] { context_.run(); });
  }
  void TearDown() override {
    on_loop([this] { server_.stop(); });
    thread_.join();
  }

  void publish(std::uint16_t port, const std::string& report, ReportClass report_class = ReportClass::att) {
    on_loop([&] { server_.publish(report_class, port, report); });
  }

  std::unique_ptr<Client> watcher(const std::string& more = "") {
    auto client = std::make_unique<Client>(server_.port());
    client->send("?WATCH={\"enable\":true,\"json\":true" + more + "};\n");
    client->line_with("\"class\":\"WATCH\"");
    return client;
  }

  TwoDevices source_;
  boost::asio::io_context context_{1};
  StatusServer server_{listen_status(context_.get_executor(), settings()), settings(), source_};
  std::thread thread_;
};

TEST_F(StatusServerTest, GreetsWithItsVersionAndAnswersEveryRequestOfALine) {
  Client client(server_.port());
  const json version = json::parse(client.line().value());
  EXPECT_EQ(version["class"], "VERSION");
  EXPECT_EQ(version["proto_major"], 3);
  EXPECT_EQ(version["proto_minor"], 14);
  client.send("?DEVICES;?POLL;?NONSENSE;?DEVICE={\"path\":\"gps\"};?WATCH;?VERSION;\n");
  for (const char* expected : {"DEVICES", "POLL", "ERROR", "DEVICE", "DEVICES", "WATCH", "VERSION"}) {
    EXPECT_EQ(json::parse(client.line().value())["class"], expected);
  }
}

TEST_F(StatusServerTest, TakesARequestWithoutItsNewline) {
  Client client(server_.port());
  client.send("?WATCH={\"enable\":true,\"json\":true}");
  EXPECT_EQ(json::parse(client.line_with("\"WATCH\""))["json"], true);
}

TEST_F(StatusServerTest, ReportsGoToThoseWhoWatchThatDeviceOnly) {
  const auto all = watcher();
  const auto gps_only = watcher(",\"device\":\"gps\"");
  Client silent(server_.port());
  publish(0, "{\"from\":\"compass\"}\n");
  publish(1, "{\"from\":\"gps\"}\n");
  EXPECT_EQ(all->line(), "{\"from\":\"compass\"}");
  EXPECT_EQ(all->line(), "{\"from\":\"gps\"}");
  EXPECT_EQ(gps_only->line(), "{\"from\":\"gps\"}");
  silent.line();
  silent.send("?VERSION;\n");
  EXPECT_NE(silent.line().value().find("VERSION"), std::string::npos) << "nothing but the answer";
  EXPECT_TRUE(on_loop([this] { return server_.watched(ReportClass::att, 0); }));
}

TEST_F(StatusServerTest, AClientThatChoosesClassesGetsNoOthers) {
  const auto usual = watcher();
  const auto chosen = watcher(R"(,"classes":["TPV","STATE"])");
  publish(0, "{\"from\":\"att\"}\n");
  publish(1, "{\"from\":\"tpv\"}\n", ReportClass::tpv);
  on_loop([this] { server_.publish_health({"{\"class\":\"HEALTH\""}); });
  on_loop([this] { server_.publish_state("{\"from\":\"state\"}\n", 0, true); });
  EXPECT_EQ(chosen->line(), "{\"from\":\"tpv\"}");
  EXPECT_EQ(chosen->line(), "{\"from\":\"state\"}");
  EXPECT_EQ(usual->line(), "{\"from\":\"att\"}");
  EXPECT_EQ(usual->line(), "{\"from\":\"tpv\"}");
  EXPECT_NE(usual->line().value().find("HEALTH"), std::string::npos);
  publish(0, "{\"from\":\"att\"}\n");
  EXPECT_EQ(usual->line(), "{\"from\":\"att\"}") << "and no STATE, which is only for those who ask";
  EXPECT_GT(source_.watch_changes, 0);
}

TEST_F(StatusServerTest, WhatNobodyWatchesNeedNotBeWritten) {
  const auto chosen = watcher(R"(,"classes":["TPV"],"rate_Hz":{"TPV":0.01})");
  const auto watched = [&](ReportClass report) { return on_loop([&] { return server_.watched(report, 0); }); };
  EXPECT_FALSE(watched(ReportClass::att));
  EXPECT_FALSE(on_loop([this] { return server_.watched(ReportClass::calib); }));
  EXPECT_FALSE(on_loop([this] { return server_.wants_state_of_words(); }));
  EXPECT_TRUE(watched(ReportClass::tpv));
  publish(0, "{\"n\":1}\n", ReportClass::tpv);
  EXPECT_FALSE(watched(ReportClass::tpv)) << "its next turn is in a hundred seconds";
  publish(0, "{\"n\":2}\n", ReportClass::tpv);
  publish(1, "{\"n\":3}\n", ReportClass::tpv);
  EXPECT_EQ(chosen->line(), "{\"n\":1}");
  EXPECT_EQ(chosen->line(), "{\"n\":3}") << "another device has its own turn";
}

TEST_F(StatusServerTest, StateAtARateIsDueOnOneGridForAllOfThatRate) {
  EXPECT_EQ(on_loop([this] { return server_.next_state_ns(); }), INT64_MAX);
  const auto first = watcher(R"(,"classes":["STATE"],"rate_Hz":{"STATE":10})");
  const auto second = watcher(R"(,"classes":["STATE"],"rate_Hz":{"STATE":10})");
  const auto of_words = watcher(R"(,"classes":["STATE"])");
  constexpr std::int64_t kMs = 1'000'000;
  const auto state = [&](std::int64_t now_ms, bool of_word) {
    on_loop([&] { server_.publish_state("{\"at\":" + std::to_string(now_ms) + "}\n", now_ms * kMs, of_word); });
  };
  state(1030, false);
  EXPECT_EQ(on_loop([this] { return server_.next_state_ns(); }), 1100 * kMs);
  state(1060, false);
  state(1070, true);
  state(1101, false);
  EXPECT_EQ(on_loop([this] { return server_.next_state_ns(); }), 1200 * kMs) << "late once, and the grid stays";
  for (const auto& client : {first.get(), second.get()}) {
    EXPECT_EQ(client->line(), "{\"at\":1030}");
    EXPECT_EQ(client->line(), "{\"at\":1101}");
  }
  EXPECT_EQ(of_words->line(), "{\"at\":1070}");
}

TEST_F(StatusServerTest, TheWatchAnswerSaysWhatWasChosenAndNothingMoreToOthers) {
  Client client(server_.port());
  client.send("?WATCH={\"json\":true};\n");
  const json usual = json::parse(client.line_with("\"WATCH\""));
  EXPECT_FALSE(usual.contains("classes"));
  EXPECT_FALSE(usual.contains("rate_Hz"));
  client.send(R"(?WATCH={"classes":["STATE","TPV"],"rate_Hz":{"STATE":10,"TPV":0.3}};)");
  const json chosen = json::parse(client.line_with("\"WATCH\""));
  EXPECT_EQ(chosen["classes"], json::parse(R"(["TPV","STATE"])"));
  EXPECT_EQ(chosen["rate_Hz"], json::parse(R"({"TPV":0.3,"STATE":10})"));
  client.send(R"(?WATCH={"classes":[],"rate_Hz":null};)");
  const json none = json::parse(client.line_with("\"WATCH\""));
  EXPECT_EQ(none["classes"], json::array());
  EXPECT_FALSE(none.contains("rate_Hz"));
  client.send(R"(?WATCH={"classes":["SONAR"]};)");
  EXPECT_NE(client.line_with("ERROR").find("known are TPV, SKY"), std::string::npos);
  client.send(R"(?WATCH={"classes":null};)");
  EXPECT_FALSE(json::parse(client.line_with("\"WATCH\"")).contains("classes"));
}

TEST_F(StatusServerTest, RecordsGoOnlyToThoseWhoAskForThem) {
  const RecordKey compass{record::topic::kCompass, 0, true}, event{record::topic::kEvent, std::nullopt, false};
  const auto watched = [&](const RecordKey& key) { return on_loop([&] { return server_.watched(key); }); };
  const auto record = [&](const RecordKey& key, const std::string& line) {
    on_loop([&] { server_.publish(key, line + "\n"); });
  };
  const auto usual = watcher();
  EXPECT_FALSE(watched(compass)) << "whoever does not ask costs nothing";
  const auto all = watcher(R"(,"classes":["RECORD"])");
  const auto gps_only = watcher(R"(,"classes":["RECORD"],"device":"gps")");
  EXPECT_TRUE(watched(compass));
  record(compass, "{\"n\":1}");
  record(event, "{\"n\":2}");
  publish(0, "{\"from\":\"att\"}\n");
  EXPECT_EQ(all->line(), "{\"n\":1}");
  EXPECT_EQ(all->line(), "{\"n\":2}");
  EXPECT_EQ(gps_only->line(), "{\"n\":2}") << "what is of no device goes to everybody";
  EXPECT_EQ(usual->line(), "{\"from\":\"att\"}");
  all->send(R"(?WATCH={"topics":["/event"]};)");
  EXPECT_EQ(json::parse(all->line_with("\"WATCH\""))["topics"], json::parse(R"(["/event"])"));
  EXPECT_FALSE(watched(compass)) << "nobody has chosen this topic and this device";
  EXPECT_TRUE(watched(event));
}

TEST_F(StatusServerTest, ATopicWithARateOfItsOwnLeavesTheRateOfOthers) {
  const auto client =
      watcher(R"(,"classes":["RECORD"],"rate_Hz":{"RECORD":0.01},"topic_rate_Hz":{"/compass":null,"/gps":0.02})");
  const RecordKey keys[] = {{record::topic::kCompass, 0, true}, {record::topic::kImu, 1, true},
                            {record::topic::kGps, 2, true},     {record::topic::kCompass, 0, true},
                            {record::topic::kImu, 1, true},     {record::topic::kGps, 2, true},
                            {record::topic::kCompass, 0, true}};
  int n = 0;
  for (const RecordKey& key : keys) on_loop([&] { server_.publish(key, std::to_string(n++) + "\n"); });
  for (const char* expected : {"0", "1", "2", "3", "6"}) EXPECT_EQ(client->line(), expected);
  client->send("?WATCH;");
  EXPECT_EQ(json::parse(client->line_with("\"WATCH\""))["topic_rate_Hz"],
            json::parse(R"({"/compass":null,"/gps":0.02})"));
}

TEST_F(StatusServerTest, ARateOfRecordsCountsForEachTopicAndDeviceAndNeverDropsAnEvent) {
  const auto slow = watcher(R"(,"classes":["RECORD"],"rate_Hz":{"RECORD":0.01})");
  const RecordKey keys[] = {
      {record::topic::kCompass, 0, true},           {record::topic::kCompass, 0, true},
      {record::topic::kCompass, 1, true},           {record::topic::kGps, 1, true},
      {record::topic::kEvent, std::nullopt, false}, {record::topic::kEvent, std::nullopt, false}};
  int n = 0;
  for (const RecordKey& key : keys) on_loop([&] { server_.publish(key, std::to_string(n++) + "\n"); });
  for (const char* expected : {"0", "2", "3", "4", "5"}) EXPECT_EQ(slow->line(), expected);
  EXPECT_FALSE(on_loop([&] { return server_.watched(keys[0]); }));
}

TEST_F(StatusServerTest, RecordsTellTopicsAndSchemasAsTheLogHasThem) {
  Client client(server_.port());
  client.send("?RECORDS;");
  const std::string line = client.line_with("\"RECORDS\"");
  const json records = json::parse(line);
  ASSERT_EQ(records["topics"].size(), record::json_topics().size() - 1) << "all but /config";
  for (const record::Topic& topic : record::json_topics()) {
    if (topic.name == "/config") continue;
    EXPECT_NE(line.find("{\"topic\":\"" + std::string(topic.name) + "\",\"schema_name\":\"" +
                        std::string(topic.schema_name) + "\",\"schema\":" + record::json_schema(topic) + "}"),
              std::string::npos)
        << topic.name;
  }
}

TEST_F(StatusServerTest, SentencesGoToThoseWhoAskForNmeaAndToOthersNot) {
  const NmeaKey serving{ReportClass::tpv, 1, true}, spare{ReportClass::tpv, 0, false};
  const auto watched = [&](const NmeaKey& key) { return on_loop([&] { return server_.watched(key); }); };
  const auto json_only = watcher();
  EXPECT_FALSE(watched(serving)) << "whoever does not ask costs nothing";
  Client nmea(server_.port());
  nmea.send(R"(?WATCH={"class":"WATCH", "nmea":true})");
  const json policy = json::parse(nmea.line_with("\"WATCH\""));
  EXPECT_EQ(policy["nmea"], true);
  EXPECT_EQ(policy["json"], false);
  const auto spare_only = watcher(R"(,"nmea":true,"device":"compass","classes":[])");
  EXPECT_TRUE(watched(serving));
  on_loop([&] { server_.publish(serving, "$A\r\n$B\r\n"); });
  EXPECT_FALSE(watched(serving)) << "its next turn is in a tenth of a second";
  on_loop([&] { server_.publish(spare, "$C\r\n"); });
  publish(0, "{\"from\":\"att\"}\n");
  EXPECT_EQ(nmea.line(), "$A\r");
  EXPECT_EQ(nmea.line(), "$B\r");
  EXPECT_EQ(spare_only->line(), "$C\r") << "it has selected the device that does not serve";
  EXPECT_EQ(json_only->line(), "{\"from\":\"att\"}");
  nmea.send("?VERSION;");
  EXPECT_NE(nmea.line().value().find("VERSION"), std::string::npos) << "neither the other device nor JSON";
}

TEST_F(StatusServerTest, AnUnknownDeviceIsAnError) {
  Client client(server_.port());
  client.send("?WATCH={\"enable\":true,\"device\":\"sonar\"};\n");
  EXPECT_EQ(json::parse(client.line_with("ERROR"))["message"], "No such device as sonar");
  EXPECT_FALSE(on_loop([this] { return server_.watched(ReportClass::health); }));
}

TEST_F(StatusServerTest, ARequestOfAMegabyteIsRefusedAndHeldByNobody) {
  Client client(server_.port());
  const std::string megabyte(1 << 20, 'x');
  client.send(megabyte);
  client.send("?VERSION;\n");
  EXPECT_EQ(json::parse(client.line_with("ERROR"))["message"], "Request line too long");
  EXPECT_EQ(client.line(), std::nullopt);
  Client next(server_.port());
  EXPECT_TRUE(next.line());
}

TEST_F(StatusServerTest, EveryLineEndsAsThoseOfGpsd) {
  const auto client = watcher(R"(,"classes":["HEALTH","DEVICE"])");
  on_loop([this] { server_.publish_health({"{\"class\":\"HEALTH\""}); });
  on_loop([this] { server_.publish_device(0); });
  client->send("?DEVICES;?DEVICE;?RECORDS;?NONSENSE;?WATCH;?VERSION;\n");
  for (std::string line; line.find("VERSION") == std::string::npos;) {
    line = client->line().value();
    EXPECT_TRUE(line.ends_with("}\r")) << line;
  }
}

TEST_F(StatusServerTest, AClientThatWatchesNothingMakesPlaceForAnother) {
  const auto first = watcher();
  Client silent(server_.port()), asking(server_.port());
  for (Client* client : {&silent, &asking}) ASSERT_TRUE(client->line());
  asking.send("?VERSION;\n");
  ASSERT_TRUE(asking.line());
  const auto fourth = watcher();
  EXPECT_EQ(silent.line(), std::nullopt) << "it was idle for longest";
  asking.send("?VERSION;\n");
  EXPECT_TRUE(asking.line());
  publish(0, "{\"n\":1}\n");
  EXPECT_EQ(first->line(), "{\"n\":1}") << "who watches keeps its place";
  EXPECT_EQ(fourth->line(), "{\"n\":1}");
}

TEST_F(StatusServerTest, OneClientTooManyIsTold) {
  const auto first = watcher(), second = watcher(), third = watcher();
  Client fourth(server_.port());
  EXPECT_NE(fourth.line().value().find("Too many clients"), std::string::npos);
  EXPECT_EQ(fourth.line(), std::nullopt);
}

TEST_F(StatusServerTest, ASlowClientMissesWholeReportsIsToldHowManyAndHurtsNobody) {
  const auto good = watcher();
  Client slow(server_.port(), 4096);
  slow.send("?WATCH={\"enable\":true,\"json\":true};\n");
  slow.line_with("\"class\":\"WATCH\"");
  on_loop([this] { server_.publish_health({"{\"class\":\"HEALTH\""}); });
  constexpr int kReports = 5000;
  const std::string padding(200, '.');
  for (int i = 0; i < kReports; ++i) {
    publish(0, "{\"n\":" + std::to_string(i) + ",\"padding\":\"" + padding + "\"}\n");
    const auto line = good->line_with("padding");
    ASSERT_EQ(json::parse(line)["n"], i);
  }
  EXPECT_LE(on_loop([this] { return server_.queued_bytes(); }), settings().client_queue_bytes + 300);
  std::uint64_t received = 0, dropped = 0;
  int last = -1;
  while (received + dropped < kReports) {
    const json report = json::parse(slow.line().value());  // throws on a torn line
    if (report.contains("padding")) {
      EXPECT_GT(report["n"].get<int>(), last);
      last = report["n"];
      ++received;
    } else if (report["class"] == "HEALTH") {
      dropped = report["dropped"];
    }
  }
  EXPECT_EQ(received + dropped, kReports);
  EXPECT_GT(dropped, 0U);
}

TEST_F(StatusServerTest, GarbageOnlyEverGetsErrors) {
  for (const char* garbage :
       {"\xff\xfe\0\n", "GET / HTTP/1.1\r\n\r\n", "{}{}{};\n", "?WATCH={{{{;\n?WATCH=\"}\";\n", ";;;;\n"}) {
    Client client(server_.port());
    client.line();
    client.send(garbage);
    client.send("\n?VERSION;\n");
    EXPECT_NE(client.line_with("VERSION").find("proto_major"), std::string::npos);
  }
}

TEST(Listeners, ATakenPortIsExplained) {
  boost::asio::io_context context(1);
  config::StatusSettings settings;
  settings.port = 0;
  const auto first = listen_status(context.get_executor(), settings);
  settings.port = first.local_endpoint().port();
  try {
    const auto second = listen_status(context.get_executor(), settings);
    FAIL() << "both listen";
  } catch (const StartError& error) {
    EXPECT_NE(std::string(error.what()).find("is taken"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("status.port"), std::string::npos);
  }
}

TEST(Listeners, TheControlSocketHasItsPermissionsAndReplacesOnlyTheDead) {
  boost::asio::io_context context(1);
  config::ControlSettings settings;
  settings.socket = std::filesystem::temp_directory_path() / ("navcal-control-" + std::to_string(::getpid()));
  settings.mode = 0640;
  {
    const auto first = listen_control(context.get_executor(), settings);
    const auto permissions = std::filesystem::status(settings.socket).permissions();
    EXPECT_EQ(permissions, std::filesystem::perms(0640));
    EXPECT_THROW((void)listen_control(context.get_executor(), settings), StartError) << "a living one answers";
  }
  EXPECT_NO_THROW((void)listen_control(context.get_executor(), settings)) << "left behind by a dead one";
  std::filesystem::remove(settings.socket);
}

}  // namespace
}  // namespace navcal::daemon
