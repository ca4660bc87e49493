// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/signalk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

namespace navcal::web {
namespace {

using nlohmann::json;
constexpr std::int64_t kUtc_ns = 1'764'000'000'123'456'789;

json values_of(const SignalKUpdate& update) {
  json values = json::object();
  for (const auto& one : update.values) values[one.path] = one.value;
  return values;
}

TEST(SignalKModel, TheHeadingIsTrueOnlyWithADeclination) {
  SignalKModel model;
  constexpr std::string_view kNav = R"({"heading_rad":1.5,"heading_std_rad":0.1,"pitch_rad":0.1,"roll_rad":0})";
  EXPECT_FALSE(values_of(model.take({"/nav", "navigation", kUtc_ns, kNav})).contains("navigation.headingTrue"));
  const auto health =
      model.take({"/health", "", kUtc_ns, R"({"earth_field":{"declination_source":"model","declination":-90}})"});
  EXPECT_NEAR(values_of(health)["navigation.magneticVariation"].get<double>(), -std::numbers::pi / 2, 1e-12);
  const json known = values_of(model.take({"/nav", "navigation", kUtc_ns, kNav}));
  EXPECT_EQ(known["navigation.headingTrue"], 1.5);
  EXPECT_EQ(known["navigation.headingTrue.standardError"], 0.1);
  const json lost =
      values_of(model.take({"/health", "", kUtc_ns, R"({"earth_field":{"declination_source":"none"}})"}));
  EXPECT_TRUE(lost["navigation.magneticVariation"].is_null());
}

TEST(SignalKModel, WhatIsNotKnownIsToldOnceAndNeverAsZero) {
  SignalKModel model;
  const json first =
      values_of(model.take({"/nav", "navigation", kUtc_ns, R"({"lat":1,"lon":null,"altitude_m":5})"}));
  EXPECT_EQ(first, json({{"environment.depth.belowTransducer", 5}}));
  const json second = values_of(model.take({"/nav", "navigation", kUtc_ns, R"({"altitude_m":null})"}));
  EXPECT_EQ(second, json({{"environment.depth.belowTransducer", nullptr}}));
  EXPECT_TRUE(model.take({"/nav", "navigation", kUtc_ns, R"({"altitude_m":null})"}).values.empty());
}

TEST(SignalKModel, DeviationIsWhatTheCalibrationAdds) {
  SignalKModel model;
  const json values = values_of(model.take(
      {"/compass", "c", kUtc_ns,
       R"({"heading_rad":0.1,"heading_calibrated_rad":6.2,"heading_is_true":false,"heading_std_rad":0.01})"}));
  EXPECT_EQ(values["navigation.headingMagnetic"], 6.2);
  EXPECT_EQ(values["navigation.headingCompass"], 0.1);
  EXPECT_NEAR(values["navigation.magneticDeviation"].get<double>(), 6.2 - 0.1 - 2 * std::numbers::pi, 1e-12);
  EXPECT_EQ(values["navigation.headingMagnetic.standardError"], 0.01);
  EXPECT_TRUE(
      model.take({"/compass", "t", kUtc_ns, R"({"heading_rad":0.1,"heading_is_true":true})"}).values.empty())
      << "a true heading is not magnetic";
}

TEST(SignalKModel, OnlyTheDeviceThatServesIsHeard) {
  SignalKModel model;
  constexpr std::string_view kWord = R"({"heading_rad":1,"heading_is_true":false})";
  EXPECT_FALSE(model.take({"/compass", "spare", kUtc_ns, kWord}).values.empty())
      << "nothing is known of the roles";
  EXPECT_TRUE(model.take({"/health", "", kUtc_ns, R"({"sources":{"heading":"main"}})"}).values.empty());
  EXPECT_TRUE(model.take({"/compass", "spare", kUtc_ns, kWord}).values.empty());
  EXPECT_FALSE(model.take({"/compass", "main", kUtc_ns, kWord}).values.empty());
}

TEST(SignalKModel, UnitsAreThoseOfSignalK) {
  SignalKModel model;
  const json values = values_of(model.take(
      {"/battery", "pack-1", kUtc_ns, R"({"current_A":2,"charge_Ah":1,"energy_Wh":2,"charge_percent":50})"}));
  const std::string head = "electrical.batteries.pack1.";
  EXPECT_EQ(values[head + "current"], -2) << "positive while it is charged";
  EXPECT_EQ(values[head + "capacity.remainingCharge"], 3600);
  EXPECT_EQ(values[head + "capacity.remaining"], 7200);
  EXPECT_EQ(values[head + "capacity.stateOfCharge"], 0.5);
  const json course = values_of(model.take({"/nav", "navigation", kUtc_ns, R"({"velocity_m_s":[-3,-4,9]})"}));
  EXPECT_NEAR(course["navigation.speedOverGround"].get<double>(), 5, 1e-12);
  EXPECT_NEAR(course["navigation.courseOverGroundTrue"].get<double>(), std::numbers::pi + std::atan2(4, 3), 1e-12);
  for (const char* path : {"navigation.courseOverGroundTrue", "electrical.batteries.x.capacity.remaining"})
    EXPECT_TRUE(signalk_meta(path).contains("units")) << path;
  EXPECT_TRUE(signalk_meta("electrical.batteries.x").is_null());
}

TEST(SignalKModel, MessagesOfAnyShapeAreTaken) {
  SignalKModel model;
  for (const auto topic : SignalKModel::kTopics) {
    for (const char* message :
         {"", "{", "[]", "7", "{}", R"({"lat":"x","lon":[],"velocity_m_s":[1],"rate_rad_s":"x"})",
          R"({"sources":[1],"earth_field":7,"heading_rad":null,"velocity_m_s":[null,{}]})"})
      EXPECT_TRUE(model.take({topic, "", std::nullopt, message}).values.empty()) << topic << message;
  }
}

struct Wire : PeerLink {
  bool send(Payload payload) override {
    sent.push_back(json::parse(*payload.bytes));
    return true;
  }
  void close(std::string_view) override {}
  std::size_t queued_bytes() const override { return 0; }
  std::vector<json> sent;
};

class SignalKFeedTest : public testing::Test {
 protected:
  void say(std::string_view message) { hub_.publish({"/nav", "navigation", kUtc_ns, message}); }

  Hub hub_;
  std::shared_ptr<SignalKFeed> feed_ =
      std::make_shared<SignalKFeed>(hub_, "vessels.urn:mrn:imo:mmsi:230012345", "1");
};

TEST_F(SignalKFeedTest, HelloThenTheNewestThenWhatComes) {
  say(R"({"depth_m":3})");
  EXPECT_TRUE(hub_.demand().topics.empty()) << "nobody is connected";
  Wire wire;
  {
    SignalKPeer peer(feed_, wire, "/signalk/v1/stream?subscribe=self");
    peer.on_open();
    EXPECT_TRUE(hub_.demand().topics.contains("/nav"));
    ASSERT_EQ(wire.sent.size(), 2U);
    EXPECT_EQ(wire.sent[0]["self"], feed_->self());
    EXPECT_TRUE(wire.sent[0].contains("roles") && wire.sent[0].contains("version"));
    const json& update = wire.sent[1]["updates"][0];
    EXPECT_EQ(wire.sent[1]["context"], feed_->self());
    EXPECT_EQ(update["timestamp"], "2025-11-24T16:00:00.123Z") << "of validity";
    EXPECT_EQ(update["source"]["src"], "navigation");
    EXPECT_EQ(update["values"], json::parse(R"([{"path":"environment.depth.surfaceToTransducer","value":3}])"));
    EXPECT_EQ(update["meta"][0]["value"]["units"], "m");
    say(R"({"depth_m":4,"speed_m_s":1})");
    const json& next = wire.sent.at(2)["updates"][0];
    EXPECT_EQ(next["values"][0]["path"], "navigation.speedThroughWater") << "the depth was sent just now";
    EXPECT_EQ(next["meta"].size(), 1U);
    hub_.set_link({false, "gone"});
    EXPECT_EQ(wire.sent.at(3)["updates"][0]["values"].size(), 2U) << "what is not known any more is told at once";
    EXPECT_TRUE(wire.sent.at(3)["updates"][0]["values"][0]["value"].is_null());
    EXPECT_FALSE(wire.sent.at(3)["updates"][0].contains("timestamp"));
  }
  EXPECT_TRUE(hub_.demand().topics.empty());
}

TEST_F(SignalKFeedTest, WhoSubscribesToNothingGetsOnlyWhatItAsksFor) {
  Wire wire;
  SignalKPeer peer(feed_, wire, "/signalk/v1/stream?subscribe=none");
  peer.on_open();
  say(R"({"depth_m":3,"speed_m_s":1})");
  EXPECT_EQ(wire.sent.size(), 1U) << "hello alone";
  peer.on_text(R"({"context":"vessels.self","subscribe":[{"path":"environment.depth.*"}]})");
  ASSERT_EQ(wire.sent.size(), 2U) << "the newest at once";
  EXPECT_EQ(wire.sent[1]["updates"][0]["values"].size(), 1U);
  peer.on_text(R"({"context":"*","unsubscribe":[{"path":"*"}]})");
  say(R"({"depth_m":5})");
  EXPECT_EQ(wire.sent.size(), 2U);
}

TEST_F(SignalKFeedTest, AClientOutlivesTheServerWithoutHarm) {
  Wire wire;
  auto peer = std::make_unique<SignalKPeer>(feed_, wire, "/signalk/v1/stream");
  peer->on_open();
  feed_->detach();
  EXPECT_TRUE(hub_.demand().topics.empty());
  peer->on_text("{}");
  peer.reset();
}

TEST(SignalKVessel, NamesAreThoseOfTheSpecification) {
  EXPECT_EQ(problem_of_vessel(default_vessel()), "");
  EXPECT_EQ(default_vessel().size(), std::string("urn:mrn:signalk:uuid:").size() + 36);
  EXPECT_EQ(problem_of_vessel("urn:mrn:imo:mmsi:230012345"), "");
  for (const char* bad : {"", "auv", "urn:mrn:imo:mmsi:1", "urn:mrn:imo:mmsi:23001234x", "urn:mrn:signalk:uuid:7"})
    EXPECT_NE(problem_of_vessel(bad), "") << bad;
}

TEST(SignalKVessel, DiscoveryNamesTheHostThatWasAsked) {
  const json answer = json::parse(signalk_discovery("auv.local:8765", "1"));
  EXPECT_EQ(answer["endpoints"]["v1"]["signalk-ws"], "ws://auv.local:8765/signalk/v1/stream");
  EXPECT_TRUE(json::accept(signalk_discovery("a\"b\xff", "1")));
}

}  // namespace
}  // namespace navcal::web
