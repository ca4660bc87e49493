// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/web/foxglove_link.h"
#include "web/foxglove/channels.h"
#include "web/foxglove/peer.h"
#include "web/foxglove/protocol.h"

namespace navcal::web::foxglove {
namespace {

using nlohmann::json;

TEST(FoxgloveProtocol, HeadsOfBinaryMessagesAreLittleEndianAndThePayloadFollowsByteForByte) {
  const std::string payload("{\"a\":\"\0\xff\"}", 10);
  for (const std::uint32_t id : {0U, 1U, 0x01020304U, 0xffffffffU}) {
    for (const std::uint64_t time_ns :
         {std::uint64_t{0}, std::uint64_t{1'700'000'000'123'456'789}, ~std::uint64_t{0}}) {
      const std::string bytes = message_data(id, time_ns, payload);
      ASSERT_EQ(bytes.size(), 13 + payload.size());
      EXPECT_EQ(bytes[0], 1);
      EXPECT_EQ(FakeLink::number(bytes, 1, 4), id);
      EXPECT_EQ(FakeLink::number(bytes, 5, 8), time_ns);
      EXPECT_EQ(bytes.substr(13), payload);
      const std::string told = foxglove::time(time_ns);
      ASSERT_EQ(told.size(), 9U);
      EXPECT_EQ(told[0], 2);
      EXPECT_EQ(FakeLink::number(told, 1, 8), time_ns);
    }
  }
}

TEST(FoxgloveProtocol, ServerInfoHasWhatViewersReadOfIt) {
  const auto info = json::parse(server_info("navcal", "1.2.3", "abc"));
  EXPECT_EQ(info["op"], "serverInfo");
  EXPECT_EQ(info["name"], "navcal");
  EXPECT_EQ(info["capabilities"], json::array({"time"}));
  EXPECT_EQ(info["metadata"]["version"], "1.2.3");
  EXPECT_EQ(info["sessionId"], "abc");
}

TEST(FoxgloveProtocol, AdvertisesAnyNumberOfChannelsWithTheirSchemasAsText) {
  EXPECT_EQ(json::parse(advertise({})), (json{{"op", "advertise"}, {"channels", json::array()}}));
  const std::string first = channel(1, "/imu", "navcal.Imu", R"({"type":"object","title":"\"quoted\""})");
  const std::string second = channel(2, "/nav", "navcal.Nav", "{}");
  const auto told = json::parse(advertise({first, second}));
  ASSERT_EQ(told["channels"].size(), 2U);
  EXPECT_EQ(told["channels"][0]["id"], 1);
  EXPECT_EQ(told["channels"][0]["encoding"], "json");
  EXPECT_EQ(told["channels"][0]["schemaEncoding"], "jsonschema");
  EXPECT_EQ(told["channels"][0]["schema"], R"({"type":"object","title":"\"quoted\""})");
  EXPECT_EQ(told["channels"][1]["topic"], "/nav");
  EXPECT_EQ(told["channels"][1]["schemaName"], "navcal.Nav");
  EXPECT_EQ(json::parse(unadvertise({3, 4})), (json{{"op", "unadvertise"}, {"channelIds", {3, 4}}}));
}

TEST(FoxgloveProtocol, AStatusIsValidJsonWhateverItQuotes) {
  EXPECT_EQ(json::parse(status(StatusLevel::warning, "a\n\"b\"")),
            (json{{"op", "status"}, {"level", 1}, {"message", "a\n\"b\""}}));
  EXPECT_EQ(json::parse(status(StatusLevel::info, "cut \xc3"))["level"], 0);
  EXPECT_EQ(json::parse(status(StatusLevel::error, "a", "dropped"))["id"], "dropped");
}

TEST(FoxgloveProtocol, ReadsSubscriptionsWithTheIdsThatTheClientChose) {
  const auto message = read_client_message(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":4294967295,"channelId":5}]})");
  EXPECT_EQ(message.problems, 0U);
  ASSERT_EQ(message.subscribe.size(), 2U);
  EXPECT_EQ(message.subscribe[0].id, 0U);
  EXPECT_EQ(message.subscribe[0].channel, 3U);
  EXPECT_EQ(message.subscribe[1].id, 4294967295U);
  EXPECT_EQ(read_client_message(R"({"op":"unsubscribe","subscriptionIds":[7,8]})").unsubscribe,
            (std::vector<std::uint32_t>{7, 8}));
}

TEST(FoxgloveProtocol, SoundPartsOfAMessageCountAndTheOthersAreNamed) {
  const auto message = read_client_message(
      R"({"op":"subscribe","subscriptions":[{"id":1},{"id":2,"channelId":3},{"channelId":1},7]})");
  ASSERT_EQ(message.subscribe.size(), 1U);
  EXPECT_EQ(message.subscribe[0].id, 2U);
  EXPECT_EQ(message.problems, 3U);
  EXPECT_NE(message.problem.find("channelId"), std::string::npos);
}

class Malformed : public testing::TestWithParam<const char*> {};
TEST_P(Malformed, IsAProblemInWordsAndAsksForNothing) {
  const auto message = read_client_message(GetParam());
  EXPECT_GT(message.problems, 0U);
  EXPECT_FALSE(message.problem.empty());
  EXPECT_TRUE(message.subscribe.empty());
  EXPECT_TRUE(message.unsubscribe.empty());
}
INSTANTIATE_TEST_SUITE_P(
    ClientMessages, Malformed,
    testing::Values("", "null", "[]", "3", "{", "not json", R"({"op":3})", R"({"Op":"subscribe"})", R"({"op":""})",
                    R"({"op":"SUBSCRIBE","subscriptions":[]})", R"({"op":"subscribe"})", R"({"op":"unsubscribe"})",
                    R"({"op":"subscribe","subscriptions":{}})", R"({"op":"subscribe","subscriptions":null})",
                    R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":-1}]})",
                    R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":"1"}]})",
                    R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
                    R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})",
                    R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":18446744073709551616}]})",
                    R"({"op":"subscribe","subscriptions":[[1,2]]})",
                    R"({"op":"unsubscribe","subscriptionIds":["1"]})",
                    R"({"op":"unsubscribe","subscriptionIds":[-1]})", R"({"op":"advertise","channels":[]})",
                    R"({"op":"getParameters","parameterNames":[]})",
                    R"({"op":"fetchAsset","uri":"file:///etc/passwd","requestId":1})"));

TEST(FoxgloveProtocol, DeepNestingAndLongOpsAreOnlyProblems) {
  EXPECT_EQ(read_client_message(std::string(60'000, '[')).problems, 1U);
  const auto message = read_client_message(R"({"op":")" + std::string(60'000, 'x') + "\"}");
  EXPECT_EQ(message.problems, 1U);
  EXPECT_LT(message.problem.size(), 200U);
}

TEST(FoxgloveSchemas, AreObjectsWithoutReferences) {
  for (const auto& parsed : json::parse(schemas_json())) {
    EXPECT_EQ(parsed["type"], "object");
    EXPECT_TRUE(parsed["title"].get<std::string>().starts_with("foxglove."));
    EXPECT_EQ(parsed["properties"]["timestamp"]["title"], "time");
    EXPECT_EQ(parsed.dump().find("$ref"), std::string::npos);
  }
}

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(FoxgloveDropCount, TellsHowManyWereDroppedAndWhen) {
  DropCount drops;
  EXPECT_FALSE(drops.report(5 * kSecond_ns));
  drops.dropped(1'700'000'000 * kSecond_ns);
  drops.dropped(1'700'000'001 * kSecond_ns + 250'000'000);
  const auto words = drops.report(1'700'000'002 * kSecond_ns);
  ASSERT_TRUE(words);
  EXPECT_NE(words->find("2 messages"), std::string::npos) << *words;
  EXPECT_NE(words->find("2023-11-14T22:13:20.000Z to 2023-11-14T22:13:21.250Z"), std::string::npos) << *words;
  EXPECT_FALSE(drops.report(1'700'000'009 * kSecond_ns));
}

TEST(FoxgloveDropCount, ReportsAtMostOnceASecondAndLosesNoCount) {
  DropCount drops;
  drops.dropped(kSecond_ns);
  EXPECT_TRUE(drops.report(kSecond_ns));
  drops.dropped(kSecond_ns + 1);
  EXPECT_FALSE(drops.report(kSecond_ns + 2));
  drops.dropped(kSecond_ns + 3);
  const auto words = drops.report(2 * kSecond_ns);
  ASSERT_TRUE(words);
  EXPECT_NE(words->find("2 messages"), std::string::npos) << *words;
  EXPECT_NE(words->find("3 since"), std::string::npos) << *words;
  // The clock stepped back.
  drops.dropped(1);
  EXPECT_TRUE(drops.report(2));
}

}  // namespace
}  // namespace navcal::web::foxglove
