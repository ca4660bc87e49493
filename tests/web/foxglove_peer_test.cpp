// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "record/ros2/sample_messages.h"
#include "tests/web/foxglove_link.h"
#include "tests/web/web_server.h"
#include "web/foxglove/peer.h"

namespace navcal::web::foxglove {
namespace {

using nlohmann::json;

constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;
constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// A hub with some topics, and viewers without sockets.
class FoxgloveViewer : public testing::Test {
 protected:
  struct One {
    FakeLink link;
    std::unique_ptr<Peer> peer;
    void says(const std::string& text) const { peer->on_text(text); }
    void subscribes(std::uint32_t id, std::uint32_t channel) const {
      says(json{{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}}.dump());
    }
  };

  void SetUp() override {
    hub.set_link({true, ""});
    hub.set_topics(topics({"/imu", "/nav", "/gps", "/event"}));
  }
  static std::vector<Topic> topics(const std::vector<std::string>& names) {
    std::vector<Topic> found;
    for (const auto& name : names) found.push_back({name, "navcal." + name.substr(1), R"({"type":"object"})"});
    return found;
  }
  std::unique_ptr<One> viewer() {
    auto one = std::make_unique<One>();
    one->peer = made.make_peer(one->link, "/");
    one->peer->on_open();
    return one;
  }
  /// Ids by topic, of everything that was advertised; what was sent is forgotten.
  static std::map<std::string, std::uint32_t> channels(One& one) {
    std::map<std::string, std::uint32_t> found;
    for (const auto& told : one.link.take("advertise")) {
      for (const auto& channel : told["channels"])
        found[channel["topic"].get<std::string>()] = channel["id"].get<std::uint32_t>();
    }
    return found;
  }
  void publish(std::string_view topic, std::optional<std::int64_t> utc_ns, std::string_view message) {
    hub.publish({topic, "device", utc_ns, message});
  }
  /// The one error that a message gets.
  static std::string error_of(One& one, const std::string& text) {
    one.link.sent.clear();
    one.says(text);
    const auto told = one.link.take("status");
    if (told.size() != 1 || told[0]["level"] != 2) return {};
    return told[0]["message"].get<std::string>();
  }

  Hub hub;
  std::int64_t now_ns = kStart_ns;
  WebSocketEndpoint made = endpoint(hub, "1.2.3", [this] { return now_ns; });
};

TEST_F(FoxgloveViewer, IsGreetedAndToldOfAllTopicsAndOfFoxglovesOwn) {
  const auto one = viewer();
  ASSERT_GE(one->link.sent.size(), 2U);
  const auto info = json::parse(*one->link.sent[0].bytes);
  EXPECT_EQ(info["op"], "serverInfo");
  EXPECT_EQ(info["metadata"]["version"], "1.2.3");
  const auto told = channels(*one);
  for (const char* topic :
       {"/imu", "/nav", "/gps", "/event", "/foxglove/location", "/foxglove/pose", "/foxglove/tf", "/foxglove/log"})
    EXPECT_TRUE(told.contains(topic)) << topic;
  EXPECT_EQ(told.size(), 8U);
}

constexpr const char* kImu = R"({"device":"imu 1","rate_rad_s":[0.1,0.2,0.3],"rate_std_rad_s":0.01})";

TEST_F(FoxgloveViewer, IsToldOfTopicsOfRosWithTheFirstMessageThatHasOne) {
  const auto one = viewer();
  channels(*one);
  publish("/imu", std::nullopt, kImu);
  publish("/imu", kStart_ns, R"({"device":"imu 1","temperature_C":null})");
  publish("/event", kStart_ns, R"({"severity":"info","name":"mark"})");
  EXPECT_TRUE(one->link.take("advertise").empty())
      << "without UTC there is no stamp; the others have no type in ROS";
  publish("/imu", kStart_ns, kImu);
  const auto told = one->link.take("advertise");
  ASSERT_EQ(told.size(), 1U);
  const auto& channel = told[0]["channels"][0];
  EXPECT_EQ(channel["topic"], "/navcal/imu_1/data");
  EXPECT_EQ(channel["encoding"], "cdr");
  EXPECT_EQ(channel["schemaEncoding"], "ros2msg");
  EXPECT_EQ(channel["schemaName"], "sensor_msgs/msg/Imu");
  EXPECT_NE(channel["schema"].get<std::string>().find("MSG: geometry_msgs/Vector3"), std::string::npos);
  publish("/imu", kStart_ns + 1, kImu);
  EXPECT_TRUE(one->link.take("advertise").empty()) << "told once";
  EXPECT_TRUE(channels(*viewer()).contains("/navcal/imu_1/data")) << "who comes later is told at once";
  hub.set_topics(topics({"/nav"}));
  EXPECT_FALSE(channels(*viewer()).contains("/navcal/imu_1/data")) << "its source has gone";
}

TEST_F(FoxgloveViewer, ATopicOfRosMayHaveSeveralSources) {
  hub.set_topics(topics({"/imu", "/compass"}));
  publish("/imu", kStart_ns, R"({"device":"rov","temperature_C":12.5})");
  publish("/compass", kStart_ns, R"({"device":"rov","temperature_C":13.5})");
  const auto one = viewer();
  one->subscribes(1, channels(*one)["/navcal/rov/temperature"]);
  EXPECT_EQ(hub.demand().topics, (std::set<std::string, std::less<>>{"/compass", "/imu"}));
  EXPECT_EQ(one->link.messages().size(), 2U);
}

TEST_F(FoxgloveViewer, EachViewerIsToldOfANewTopicOfRos) {
  const auto first = viewer(), second = viewer();
  channels(*first), channels(*second);
  publish("/imu", kStart_ns, kImu);
  EXPECT_TRUE(channels(*first).contains("/navcal/imu_1/data"));
  EXPECT_TRUE(channels(*second).contains("/navcal/imu_1/data"));
}

TEST_F(FoxgloveViewer, GetsMessagesOfRosAsABagHasThem) {
  publish("/imu", kStart_ns, kImu);
  const auto one = viewer();
  one->subscribes(3, channels(*one)["/navcal/imu_1/data"]);
  EXPECT_EQ(hub.demand().topics, (std::set<std::string, std::less<>>{"/imu"}));
  publish("/imu", kStart_ns + 7, kImu);
  publish("/imu", std::nullopt, kImu);
  publish("/imu", kStart_ns + 8, R"({"device":"other","rate_rad_s":[1,2,3]})");
  const auto got = one->link.messages();
  const auto bag = record::SampleMessages().made_of("/imu", kImu, kStart_ns + 7);
  ASSERT_EQ(bag.size(), 1U);
  ASSERT_FALSE(got.empty());
  EXPECT_EQ(got.back().payload, bag[0].cdr) << "the last one: the other port has a topic of its own";
  EXPECT_EQ(got.back().time_ns, static_cast<std::uint64_t>(kStart_ns + 7));
}

TEST_F(FoxgloveViewer, EachStartHasASessionOfItsOwnAndEachViewerOfAStartTheSame) {
  const auto session = [](const One& one) { return json::parse(*one.link.sent[0].bytes)["sessionId"]; };
  const auto first = viewer(), second = viewer();
  EXPECT_EQ(session(*first), session(*second));
  FakeLink link;
  const auto other = endpoint(hub, "1.2.3").make_peer(link, "/");
  other->on_open();
  EXPECT_NE(json::parse(*link.sent[0].bytes)["sessionId"], session(*first));
}

TEST_F(FoxgloveViewer, NothingIsAskedOfNavcaldBeforeAChannelIsSubscribed) {
  auto one = viewer();
  EXPECT_TRUE(hub.demand().topics.empty());
  EXPECT_FALSE(hub.demand().all_topics);
  auto told = channels(*one);
  one->subscribes(5, told["/imu"]);
  EXPECT_EQ(hub.demand().topics, (std::set<std::string, std::less<>>{"/imu"}));
  EXPECT_FALSE(hub.demand().rate_Hz) << "every record";
  one->subscribes(6, told["/foxglove/location"]);
  EXPECT_EQ(hub.demand().topics, (std::set<std::string, std::less<>>{"/gps", "/imu", "/nav"}));
  one->says(R"({"op":"unsubscribe","subscriptionIds":[5,6]})");
  EXPECT_TRUE(hub.demand().topics.empty());
  one->subscribes(5, told["/imu"]);
  one.reset();
  EXPECT_TRUE(hub.demand().topics.empty()) << "the viewer has gone";
}

TEST_F(FoxgloveViewer, GetsMessagesByteForByteWithTheTimeOfValidity) {
  const auto one = viewer();
  one->subscribes(77, channels(*one)["/imu"]);
  const std::string message = R"({"class":"IMU",  "x":1.0e-3,"crc":"0badcafe"})";
  publish("/imu", kStart_ns + 5, message);
  publish("/nav", kStart_ns + 6, "{}");
  const auto got = one->link.messages();
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(got[0].subscription, 77U);
  EXPECT_EQ(got[0].time_ns, static_cast<std::uint64_t>(kStart_ns + 5));
  EXPECT_EQ(got[0].payload, message);
}

TEST_F(FoxgloveViewer, GetsTheNewestOfEachDeviceAtOnceWhenItSubscribes) {
  publish("/imu", kStart_ns, R"({"a":1})");
  hub.publish({"/imu", "other", kStart_ns + 1, R"({"a":2})"});
  publish("/event", kStart_ns + 9, "{}");
  const auto one = viewer();
  const auto told = channels(*one);
  one->subscribes(1, told.at("/imu"));
  EXPECT_EQ(one->link.messages().size(), 2U);
  EXPECT_EQ(one->link.times(), std::vector<std::uint64_t>{static_cast<std::uint64_t>(kStart_ns + 9)})
      << "an old message does not turn the clock back";
  one->link.sent.clear();
  one->subscribes(2, told.at("/event"));
  ASSERT_EQ(one->link.messages().size(), 1U) << "those of /imu are not repeated";
  EXPECT_EQ(one->link.messages()[0].subscription, 2U);
}

TEST_F(FoxgloveViewer, IsToldTheTimeBeforeEachMessageThatIsNewer) {
  const auto one = viewer();
  one->subscribes(1, channels(*one)["/imu"]);
  for (const int ms : {10, 30, 20, 40}) publish("/imu", kStart_ns + ms * kMillisecond_ns, R"({"a":1})");
  std::vector<int> got;
  for (const std::uint64_t time_ns : one->link.times())
    got.push_back(static_cast<int>((static_cast<std::int64_t>(time_ns) - kStart_ns) / kMillisecond_ns));
  EXPECT_EQ(got, (std::vector<int>{10, 30, 40})) << "a late record does not turn the clock back";
  one->link.sent.clear();
  publish("/imu", kStart_ns - 3600 * 1000 * kMillisecond_ns, R"({"a":1})");
  EXPECT_EQ(one->link.times().size(), 1U) << "a step of the clock does";
}

TEST_F(FoxgloveViewer, WithoutATimeOfValidityTheNewestTimeStands) {
  const auto one = viewer();
  one->subscribes(1, channels(*one)["/imu"]);
  publish("/imu", std::nullopt, R"({"a":1})");
  publish("/imu", kStart_ns + 7, R"({"a":2})");
  publish("/imu", std::nullopt, R"({"a":3})");
  const auto got = one->link.messages();
  ASSERT_EQ(got.size(), 3U);
  EXPECT_EQ(got[0].time_ns, static_cast<std::uint64_t>(now_ns));
  EXPECT_EQ(got[2].time_ns, static_cast<std::uint64_t>(kStart_ns + 7));
}

TEST_F(FoxgloveViewer, OneRecordGivesAllThatIsDerivedFromItToAllViewers) {
  const auto one = viewer(), two = viewer();
  auto told = channels(*one);
  EXPECT_EQ(told, channels(*two)) << "ids are the same for all";
  for (One* who : {one.get(), two.get()}) {
    who->subscribes(1, told["/foxglove/pose"]);
    who->subscribes(2, told["/foxglove/tf"]);
    who->subscribes(3, told["/foxglove/location"]);
    who->subscribes(4, told["/nav"]);
  }
  publish("/nav", kStart_ns, R"({"position":"reckoned","lat":59,"lon":18,"heading_rad":1})");
  publish("/gps", kStart_ns, R"({"fix":"3d","lat":59,"lon":18,"device":"gps"})");
  for (One* who : {one.get(), two.get()}) {
    std::map<std::uint32_t, std::vector<json>> got;
    for (const auto& message : who->link.messages())
      got[message.subscription].push_back(json::parse(message.payload));
    EXPECT_EQ(got[1].size(), 1U);
    EXPECT_EQ(got[2].size(), 1U);
    EXPECT_EQ(got[4].size(), 1U);
    ASSERT_EQ(got[3].size(), 2U);
    EXPECT_EQ(got[3][0]["frame_id"], "vehicle");
    EXPECT_EQ(got[3][1]["frame_id"], "gps");
    EXPECT_TRUE(got[1][0].contains("pose"));
    EXPECT_TRUE(got[2][0].contains("rotation"));
  }
}

TEST_F(FoxgloveViewer, ErrorsAreAnsweredAndEndNothing) {
  const auto one = viewer();
  auto told = channels(*one);
  one->subscribes(1, told["/imu"]);
  EXPECT_NE(error_of(*one, R"({"op":"subscribe","subscriptions":[{"id":2,"channelId":4711}]})").find("4711"),
            std::string::npos);
  const auto subscribe = [](std::uint32_t id, std::uint32_t channel) {
    return json{{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}}.dump();
  };
  EXPECT_NE(error_of(*one, subscribe(1, told["/nav"])).find("in use"), std::string::npos);
  EXPECT_NE(error_of(*one, subscribe(2, told["/imu"])).find("already"), std::string::npos);
  EXPECT_NE(error_of(*one, R"({"op":"unsubscribe","subscriptionIds":[99]})").find("99"), std::string::npos);
  EXPECT_NE(error_of(*one, R"({"op":"advertise","channels":[]})"), "");
  EXPECT_NE(error_of(*one, "{"), "");
  one->link.sent.clear();
  one->peer->on_binary(std::string_view("\x01\0\0\0\0", 5));
  EXPECT_EQ(one->link.take("status").at(0)["level"], 2);
  one->peer->on_binary("");
  EXPECT_FALSE(one->link.is_closed);
  one->link.sent.clear();
  publish("/imu", kStart_ns, R"({"a":1})");
  EXPECT_EQ(one->link.messages().size(), 1U) << "the first subscription is still there, once";
}

TEST_F(FoxgloveViewer, AMessageWithManyProblemsGetsOneAnswer) {
  const auto one = viewer();
  json message{{"op", "subscribe"}, {"subscriptions", json::array()}};
  for (int i = 0; i < 1000; ++i) message["subscriptions"].push_back({{"id", i}, {"channelId", 5000 + i}});
  EXPECT_NE(error_of(*one, message.dump()).find("999 other problems"), std::string::npos);
}

TEST_F(FoxgloveViewer, ChannelsGoWithTheLinkAndComeBackWithTheSameIds) {
  const auto one = viewer();
  auto told = channels(*one);
  one->subscribes(1, told["/imu"]);
  one->link.sent.clear();
  hub.set_link({false, "navcald closed the connection"});
  const auto lost = one->link.sent;
  const auto gone = one->link.take("unadvertise");
  ASSERT_EQ(gone.size(), 1U);
  EXPECT_EQ(gone[0]["channelIds"].size(), told.size());
  one->link.sent = lost;
  EXPECT_EQ(one->link.take("status").at(0)["message"], "navcald closed the connection");
  EXPECT_TRUE(hub.demand().topics.empty());

  one->says(R"({"op":"unsubscribe","subscriptionIds":[1]})");
  EXPECT_TRUE(one->link.take("status").empty()) << "viewers end what ended with its channel";
  hub.set_link({true, ""});
  hub.set_topics(topics({"/imu"}));
  hub.set_topics(topics({"/imu", "/nav", "/gps", "/event"}));
  EXPECT_EQ(channels(*one), told);
  one->subscribes(1, told["/imu"]);
  publish("/imu", kStart_ns, R"({"a":1})");
  EXPECT_EQ(one->link.messages().size(), 1U);
}

TEST_F(FoxgloveViewer, ATopicWithAnotherSchemaIsAnotherChannel) {
  const auto one = viewer();
  auto told = channels(*one);
  auto changed = topics({"/imu", "/nav", "/gps", "/event"});
  changed[0].schema = R"({"type":"object","properties":{}})";
  hub.set_topics(changed);
  const auto sent = one->link.sent;
  EXPECT_EQ(one->link.take("unadvertise").at(0)["channelIds"], json{told["/imu"]});
  one->link.sent = sent;
  const auto again = channels(*one);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_NE(again.at("/imu"), told["/imu"]);
}

TEST_F(FoxgloveViewer, AClientThatDoesNotReadIsToldWhatItMissedOnceItReads) {
  const auto one = viewer();
  one->subscribes(1, channels(*one)["/imu"]);
  one->link.is_full = true;
  for (int i = 0; i < 3; ++i) publish("/imu", kStart_ns + i, R"({"a":1})");
  hub.set_link({false, "gone"});
  one->link.is_full = false;
  EXPECT_TRUE(one->link.sent.empty());
  one->peer->on_drained();
  const auto sent = one->link.sent;
  const auto told = one->link.take("status");
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0]["level"], 1);
  EXPECT_NE(told[0]["message"].get<std::string>().find("3 messages were dropped from 2023-11-14T22:13:20.000Z"),
            std::string::npos);
  one->link.sent = sent;
  EXPECT_EQ(one->link.take("unadvertise").size(), 1U) << "channels are never missed";
  one->peer->on_drained();
  EXPECT_TRUE(one->link.sent.empty());
}

TEST_F(FoxgloveViewer, WithoutNavcaldThereAreNoChannelsAndTheReasonIsTold) {
  hub.set_link({false, "navcald at 127.0.0.1 port 2947: Connection refused"});
  const auto one = viewer();
  const auto sent = one->link.sent;
  EXPECT_EQ(one->link.take("advertise").at(0)["channels"], json::array());
  one->link.sent = sent;
  EXPECT_NE(one->link.take("status").at(0)["message"].get<std::string>().find("refused"), std::string::npos);
}

TEST(FoxgloveEndpoint, EchoesTheSubprotocolThatTheClientPrefersAndLetsForeignPagesLook) {
  Hub hub;
  test::WebServer server;
  server.site.add(endpoint(hub, "1.2.3"));
  server.start();
  const std::string origin = "https://app.foxglove.dev";
  for (const auto& [offered, chosen] :
       {std::pair{"foxglove.websocket.v1", "foxglove.websocket.v1"},
        std::pair{"foxglove.sdk.v1", "foxglove.sdk.v1"},
        std::pair{"foxglove.sdk.v1, foxglove.websocket.v1", "foxglove.sdk.v1"},
        std::pair{"x, foxglove.websocket.v1, foxglove.sdk.v1", "foxglove.websocket.v1"}}) {
    test::WebSocketClient client(server.port(), "/", offered, origin);
    EXPECT_EQ(client.status(), 101U);
    EXPECT_EQ(client.subprotocol(), chosen);
    EXPECT_EQ(json::parse(client.read())["op"], "serverInfo");
  }
  EXPECT_EQ(test::WebSocketClient(server.port(), "/", "foxglove.websocket.v2", origin).status(), 404U);
  EXPECT_EQ(test::WebSocketClient(server.port(), "/", "", origin).status(), 404U);
}

TEST(FoxgloveEndpoint, AClientThatReadsAgainLearnsWhatItMissed) {
  Hub hub;
  ServerLimits limits;
  limits.queue_bytes = 64 << 10;
  test::WebServer server(limits);
  server.site.add(endpoint(hub, "1.2.3"));
  server.start();
  server.in_loop([&] {
    hub.set_link({true, ""});
    hub.set_topics({{"/imu", "navcal.Imu", R"({"type":"object"})"}});
  });
  test::WebSocketClient client(server.port(), "/", "foxglove.sdk.v1", "", 4096);
  EXPECT_EQ(json::parse(client.read())["op"], "serverInfo");
  const auto told = json::parse(client.read());
  const auto id = told["channels"][0]["id"].get<int>();
  client.send(json{{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", id}}}}}.dump());
  while (server.in_loop([&] { return hub.demand().topics.empty(); })) ::usleep(1000);
  const std::string message = R"({"a":")" + std::string(1000, 'x') + "\"}";
  std::uint64_t published = 0;
  // More than all buffers of the kernel and of the server hold.
  while (server.counters().messages_dropped < 1000) {
    server.in_loop([&] {
      for (int i = 0; i < 1000; ++i)
        hub.publish({"/imu", "imu", kStart_ns + static_cast<std::int64_t>(++published), message});
    });
  }
  std::uint64_t received = 0, dropped = 0;
  while (dropped == 0) {
    const std::string got = client.read();
    ASSERT_NE(got, "(closed)");
    if (got[0] == 1) ++received;
    if (got[0] == '{') dropped = std::stoull(json::parse(got)["message"].get<std::string>());
  }
  EXPECT_EQ(received + dropped, published);
}

}  // namespace
}  // namespace navcal::web::foxglove
