// SPDX-License-Identifier: Apache-2.0
#include "daemon/request.h"

#include <gtest/gtest.h>

#include <random>

namespace navcal::daemon {
namespace {

using Kind = Request::Kind;

std::vector<Kind> kinds(std::string_view line) {
  std::vector<Kind> found;
  for (const auto& request : parse_requests(line)) found.push_back(request.kind);
  return found;
}

TEST(Request, SeveralCommandsInALineComeInOrder) {
  const std::vector<Kind> expected{Kind::version, Kind::watch, Kind::poll, Kind::devices, Kind::device};
  EXPECT_EQ(kinds(R"(?VERSION;?WATCH={"enable":true,"json":true};?POLL;?DEVICES;?DEVICE;)"), expected);
  EXPECT_EQ(kinds("?VERSION; ?WATCH ;\t?POLL; ?DEVICES;;; ?DEVICE\r"), expected);
}

TEST(Request, ABadCommandDoesNotTakeTheOthersWithIt) {
  const auto requests = parse_requests("?POLL;?NONSENSE;?VERSION;");
  ASSERT_EQ(requests.size(), 3U);
  EXPECT_EQ(requests[1].kind, Kind::not_understood);
  EXPECT_EQ(requests[1].message, "Unrecognized request '?NONSENSE'");
  EXPECT_EQ(requests[2].kind, Kind::version);
}

TEST(Request, NothingAsksForNothing) {
  EXPECT_TRUE(parse_requests("").empty());
  EXPECT_TRUE(parse_requests(" ;; \r").empty());
}

TEST(Request, WatchTakesWhatGpsdsClientsSend) {
  for (const char* line : {R"(?WATCH={"enable":true,"json":true};)",
                           R"(?WATCH={"enable":true,"json":true,"scaled":true,"pps":true,"raw":1,"nmea":false};)",
                           R"(?WATCH={"class":"WATCH","json":true})"}) {
    const auto requests = parse_requests(line);
    ASSERT_EQ(requests.size(), 1U) << line;
    ASSERT_TRUE(requests[0].watch) << line;
    EXPECT_TRUE(requests[0].watch->enable);
    EXPECT_EQ(requests[0].watch->json, true);
    EXPECT_FALSE(requests[0].watch->device);
  }
}

TEST(Request, WatchChangesOnlyWhatItMentions) {
  const auto requests = parse_requests(R"(?WATCH={"enable":false,"device":"gps;1"};?WATCH;)");
  ASSERT_EQ(requests.size(), 2U);
  EXPECT_FALSE(requests[0].watch->enable);
  EXPECT_FALSE(requests[0].watch->json);
  EXPECT_EQ(requests[0].watch->device, "gps;1");
  EXPECT_FALSE(requests[1].watch) << "a bare ?WATCH; only asks";
}

TEST(Request, ATopicOfRecordsMayHaveARateOfItsOwn) {
  const auto chosen = [](std::string_view text) {
    return parse_requests(text).at(0).watch->topic_intervals_ns.value().chosen();
  };
  using Chosen = std::vector<std::pair<std::string, std::int64_t>>;
  EXPECT_EQ(chosen(R"(?WATCH={"topic_rate_Hz":{"/imu":5}};)"), (Chosen{{"/imu", 200'000'000}}));
  EXPECT_EQ(chosen(R"(?WATCH={"topic_rate_Hz":{"/imu":null}};)"), (Chosen{{"/imu", 0}}));
  EXPECT_EQ(chosen(R"(?WATCH={"topic_rate_Hz":null};)"), Chosen{});
  for (const char* wrong : {R"({"/raw/gps":1})", R"({"/config":1})", R"({"imu":1})", R"({"/imu":0})",
                            R"({"/imu":1e9})", R"({"/imu":"5"})", R"("/imu")", "[1]"}) {
    const Request request = parse_requests(std::string("?WATCH={\"topic_rate_Hz\":") + wrong + "};").at(0);
    EXPECT_EQ(request.kind, Kind::not_understood) << wrong;
    EXPECT_NE(request.message.find("topic"), std::string::npos) << request.message;
  }
}

TEST(Request, TopicsOfRecordsAreChosenByName) {
  const auto topics = [](std::string_view text) { return parse_requests(text).at(0).watch->topics; };
  RecordTopics expected;
  EXPECT_TRUE(expected.add("/imu") && expected.add("/compass"));
  EXPECT_EQ(topics(R"(?WATCH={"topics":["/compass","/imu"]};)"), expected);
  EXPECT_EQ(topics(R"(?WATCH={"topics":[]};)"), RecordTopics());
  EXPECT_EQ(topics(R"(?WATCH={"topics":null};)"), RecordTopics::all());
  EXPECT_FALSE(topics(R"(?WATCH={"json":true};)"));
  for (const char* wrong :
       {R"(["/raw/gps"])", R"(["/config"])", R"(["compass"])", "[1]", "[null]", R"("/imu")", "{}"}) {
    const Request request = parse_requests(std::string("?WATCH={\"topics\":") + wrong + "};").at(0);
    EXPECT_EQ(request.kind, Kind::not_understood) << wrong;
    EXPECT_NE(request.message.find("topic"), std::string::npos) << request.message;
  }
  EXPECT_EQ(kinds("?RECORDS;"), std::vector<Kind>{Kind::records});
}

TEST(Request, WrongTypesAndBrokenJsonAreNamed) {
  EXPECT_EQ(parse_requests(R"(?WATCH={"enable":1};)").at(0).message, "Invalid WATCH: enable is true or false");
  EXPECT_EQ(parse_requests(R"(?WATCH={"enable":tru};)").at(0).message, "Invalid WATCH: not a JSON object");
  const auto message = [](const std::string& object) {
    return parse_requests("?WATCH=" + object + ";").at(0).message;
  };
  EXPECT_EQ(message(R"({"classes":"STATE"})"), "Invalid WATCH: classes is a list of classes, or null");
  EXPECT_NE(message(R"({"classes":[7]})").find("a class that is not known; known are TPV"), std::string::npos);
  EXPECT_EQ(message(R"({"rate_Hz":10})"), "Invalid WATCH: rate_Hz is an object, or null");
  EXPECT_NE(message(R"({"rate_Hz":{"SONAR":1}})").find("a class that is not known"), std::string::npos);
  for (const char* rate : {"0", "-1", "101", "\"10\"", "null", "1e308"})
    EXPECT_EQ(message(R"({"rate_Hz":{"STATE":)" + std::string(rate) + "}}"),
              "Invalid WATCH: a rate is 0.01 to 100 Hz");
  EXPECT_EQ(parse_requests("?WATCH=[];").at(0).message, "Invalid WATCH: not a JSON object");
  EXPECT_EQ(parse_requests(R"(?DEVICE={"path":"gps","bps":4800};)").at(0).message,
            "DEVICE: bps is set by the configuration only");
  EXPECT_EQ(parse_requests("?POLL={};").at(0).kind, Kind::not_understood);
}

TEST(Request, LongNonsenseIsNotRepeatedInFull) {
  const auto requests = parse_requests(std::string(4000, 'x'));
  ASSERT_EQ(requests.size(), 1U);
  EXPECT_LT(requests[0].message.size(), 120U);
}

TEST(Request, DeeplyNestedJsonIsRefusedCalmly) {
  const std::string deep = "?WATCH=" + std::string(2000, '{');
  ASSERT_EQ(parse_requests(deep).size(), 1U);
  EXPECT_EQ(parse_requests(deep)[0].kind, Kind::not_understood);
}

TEST(Request, ACommandIsCompleteWithItsSemicolonOrTheBraceThatClosesItsObject) {
  const auto complete = [](std::string_view text) { return text.substr(0, complete_length(text)); };
  EXPECT_EQ(complete("?POLL;"), "?POLL;");
  EXPECT_EQ(complete("?POLL;?VERS"), "?POLL;");
  EXPECT_EQ(complete(R"(?WATCH={"class":"WATCH", "nmea":true})"), R"(?WATCH={"class":"WATCH", "nmea":true})");
  EXPECT_EQ(complete(R"(?WATCH={"rate_Hz":{"ATT":1}}?DEVICE={"path)"), R"(?WATCH={"rate_Hz":{"ATT":1}})");
  for (const char* beginning : {"?POLL", R"(?WATCH={"device":"a;)", R"(?WATCH={"device":"a}")",
                                R"(?WATCH={"rate_Hz":{"ATT":1})", R"(?WATCH={"device":"\"})", "}", ""}) {
    EXPECT_EQ(complete(beginning), "") << beginning;
  }
  const std::vector<Kind> both{Kind::watch, Kind::poll};
  EXPECT_EQ(kinds(R"(?WATCH={"nmea":true}?POLL;)"), both);
  EXPECT_EQ(kinds(R"(?WATCH={"nmea":true} ; ?POLL)"), both);
}

TEST(Request, WatchTakesWhatTheReadersOfNmeaSend) {
  const auto open_cpn = parse_requests(R"(?WATCH={"class":"WATCH", "nmea":true})").at(0).watch;
  EXPECT_TRUE(open_cpn->enable);
  EXPECT_EQ(open_cpn->nmea, true);
  EXPECT_FALSE(open_cpn->json);
  const auto signal_k = parse_requests(R"(?WATCH={"class":"WATCH","nmea":true,"json":false})").at(0).watch;
  EXPECT_TRUE(signal_k->enable);
  EXPECT_EQ(signal_k->nmea, true);
  EXPECT_EQ(signal_k->json, false);
  const auto interval = [](std::string_view text) { return parse_requests(text).at(0).watch->nmea_interval_ns; };
  EXPECT_EQ(interval(R"(?WATCH={"nmea_rate_Hz":2};)"), 500'000'000);
  EXPECT_EQ(interval(R"(?WATCH={"nmea_rate_Hz":null};)"), kNmeaInterval_ns);
  EXPECT_FALSE(interval(R"(?WATCH={"nmea":true};)"));
  for (const char* wrong : {R"({"nmea":1})", R"({"nmea_rate_Hz":0})", R"({"nmea_rate_Hz":"2"})"}) {
    const Request request = parse_requests(std::string("?WATCH=") + wrong).at(0);
    EXPECT_NE(request.message.find("Invalid WATCH: nmea"), std::string::npos) << request.message;
  }
}

TEST(Request, GarbageNeverDoesMoreThanBeRefused) {
  std::mt19937 random(3);
  const std::string alphabet = "?WATCHPOLVERSINDE={}[]\";:,\\ truefals01\n\xff";
  std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
  for (int i = 0; i < 20'000; ++i) {
    std::string line(letter(random), ' ');
    for (auto& c : line) c = alphabet[letter(random)];
    for (const auto& request : parse_requests(line)) {
      EXPECT_EQ(request.kind == Kind::not_understood, !request.message.empty()) << line;
    }
  }
}

}  // namespace
}  // namespace navcal::daemon
