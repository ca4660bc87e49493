// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mavlink_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace navcal::web {
namespace {

constexpr std::uint32_t kGpsInput = 232, kNamedValue = 251, kText = 253, kOdometry = 331;

/// Estimates at 20 Hz, and what is made of them.
struct MavlinkFromRecords : ::testing::Test {
  explicit MavlinkFromRecords(MavlinkOptions of = {}) : options(of) {}
  void say(std::string_view topic, const nlohmann::json& message) {
    const std::string text = message.dump();
    messages.take({topic, "", utc_ns, text}, now);
  }
  void north_is_known() { say("/health", {{"earth_field", {{"declination_source", "model"}}}}); }
  void estimates(int seconds, int rate_Hz = 20) {
    for (int i = 0; i < seconds * rate_Hz; ++i) {
      say("/nav", nav);
      now += std::chrono::milliseconds(1000 / rate_Hz);
      if (utc_ns) *utc_ns += 1'000'000'000 / rate_Hz;
      if ((i + 1) % rate_Hz == 0) messages.tick();
    }
  }
  [[nodiscard]] protocols::mavlink::Payload last(std::uint32_t id) {
    return protocols::mavlink::Payload(made[id].back());
  }

  MavlinkOptions options;
  std::map<std::uint32_t, std::vector<std::vector<std::uint8_t>>> made;
  MavlinkMessages messages{options, [this](std::uint32_t id, protocols::Bytes payload) {
                             made[id].emplace_back(payload.begin(), payload.end());
                             EXPECT_EQ(payload.size(), protocols::mavlink::message_of(id)->length);
                           }};
  Pacer::Clock::time_point now = Pacer::Clock::now();
  std::optional<std::int64_t> utc_ns = 1'790'000'000'123'456'789;
  nlohmann::json nav{{"lat", -33.5},          {"lon", 179.9999},         {"depth_m", 12.5},
                     {"heading_rad", 0.0},    {"pitch_rad", 0.0},        {"roll_rad", 0.0},
                     {"north_std_m", 3.0},    {"east_std_m", 4.0},       {"depth_std_m", 0.1},
                     {"since_fix_s", 5.0},    {"heading_std_rad", 0.02}, {"velocity_m_s", {1.0, 2.0, 3.0}},
                     {"calibration", nullptr}};
};
struct GpsFromRecords : MavlinkFromRecords {
  GpsFromRecords() : MavlinkFromRecords({.odometry_Hz = 0, .gps_Hz = 5}) {}
};

TEST_F(MavlinkFromRecords, NoPositionWithoutAllOfIt) {
  const auto goes_out = [&] {
    made.clear();
    estimates(2);
    return !made[kOdometry].empty();
  };
  EXPECT_FALSE(goes_out()) << "north is not known";
  EXPECT_EQ(messages.problem(), "the declination is not known");
  north_is_known();
  EXPECT_TRUE(goes_out());
  EXPECT_EQ(messages.problem(), "");
  for (const char* const key : {"lat", "lon", "depth_m", "heading_rad", "pitch_rad", "roll_rad", "velocity_m_s"}) {
    const auto kept = std::exchange(nav[key], nullptr);
    EXPECT_FALSE(goes_out()) << key;
    EXPECT_NE(messages.problem(), "") << key;
    EXPECT_EQ(last(kText).at<std::uint8_t>(0), 4) << "said as a warning";
    nav[key] = kept;
    EXPECT_TRUE(goes_out()) << key;
  }
  say("/health", {{"heading_source", "autopilot"}});
  EXPECT_FALSE(goes_out());
  EXPECT_EQ(messages.problem(), "the heading is the autopilot's own");
  say("/health", {{"heading_source", "calibration"}});
  EXPECT_TRUE(goes_out());
  utc_ns.reset();
  EXPECT_FALSE(goes_out());
  EXPECT_EQ(messages.problem(), "UTC is not known");
}

TEST_F(MavlinkFromRecords, RareEstimatesAreNotRepeated) {
  north_is_known();
  estimates(5, 5);
  EXPECT_TRUE(made[kOdometry].empty());
  EXPECT_NE(messages.problem().find("navigation.interval_s"), std::string::npos);
  estimates(2, 10);
  EXPECT_EQ(made[kOdometry].size(), 10U) << "once ten have come in a second";
  messages.tick();
  EXPECT_EQ(messages.problem(), "no estimate comes from navcald");
  EXPECT_EQ(made[kOdometry].size(), 10U);
}

TEST_F(MavlinkFromRecords, APoseThatJumpsIsCounted) {
  north_is_known();
  estimates(3);
  const auto resets = [&] { return last(kOdometry).at<std::uint8_t>(230); };
  const int before = resets();
  estimates(1);
  EXPECT_EQ(resets(), before);
  nav["calibration"] = "2-0000abcd";
  estimates(1);
  EXPECT_EQ(resets(), before + 1) << "a new calibration";
  nav["outage_error_m"] = 30.0;
  say("/nav", nav);
  nav["outage_error_m"] = nullptr;
  estimates(1);
  EXPECT_EQ(resets(), before + 2) << "a fix after a stretch without";
}

TEST_F(MavlinkFromRecords, AnUnknownErrorOfTheTiltMakesTheCovarianceUnknown) {
  north_is_known();
  estimates(2);
  const auto odometry = last(kOdometry);
  EXPECT_TRUE(std::isnan(odometry.at<float>(60)));
  EXPECT_EQ(odometry.at<float>(16), 12.5F);
  EXPECT_EQ(odometry.at<float>(20), 1.0F) << "level and northward: no turn";
  EXPECT_EQ(odometry.vector<float>(36, 1), (std::array{1.0, 2.0, 3.0}));
  EXPECT_EQ(odometry.at<std::uint8_t>(228), 20);
}

TEST_F(GpsFromRecords, NorthIsAFullTurnAndNoYawIsZero) {
  estimates(1);
  EXPECT_EQ(made[kGpsInput].size(), 5U);
  EXPECT_TRUE(made[kOdometry].empty());
  EXPECT_EQ(last(kGpsInput).at<std::uint16_t>(63), 0) << "the declination is not known";
  north_is_known();
  estimates(1);
  EXPECT_EQ(last(kGpsInput).at<std::uint16_t>(63), 36'000);
  say("/health", {{"heading_source", "autopilot"}});
  estimates(1);
  EXPECT_EQ(last(kGpsInput).at<std::uint16_t>(63), 0) << "it does not get back what it has estimated";
  say("/health", {{"heading_source", "calibration"}});
  estimates(1);
  EXPECT_EQ(last(kGpsInput).at<float>(48), 5.0F);
  EXPECT_EQ(last(kGpsInput).at<std::int32_t>(16), 1'799'999'000);
  EXPECT_EQ(messages.problem(), "");
  nav["velocity_m_s"] = nullptr;
  nav["east_std_m"] = nullptr;
  estimates(1);
  EXPECT_EQ(last(kGpsInput).at<std::uint16_t>(56), 1 + 2 + 4 + 8 + 16 + 32 + 64 + 128);
  nav["lat"] = nullptr;
  made.clear();
  estimates(1);
  EXPECT_TRUE(made[kGpsInput].empty());
  EXPECT_EQ(messages.problem(), "there is no position yet");
}

TEST_F(MavlinkFromRecords, FiguresHaveTheTimeOfValidityAndOnlyWhatIsKnown) {
  estimates(1);
  EXPECT_TRUE(made[kNamedValue].empty()) << "the monotonic clock of navcald is not known";
  say("/time", {{"source", "system"}, {"offset", 1'789'999'000.0}, {"at", 900.0}});
  nav["north_std_m"] = nullptr;
  const std::int64_t at_ns = *utc_ns;
  say("/nav", nav);
  ASSERT_EQ(made[kNamedValue].size(), 2U);
  EXPECT_EQ(protocols::mavlink::Payload(made[kNamedValue][0]).text(8, 10), "hdg_std");
  EXPECT_EQ(last(kNamedValue).text(8, 10), "fix_age");
  EXPECT_EQ(last(kNamedValue).at<std::uint32_t>(0), (at_ns - 1'789'999'000'000'000'000) / 1'000'000);
}

TEST_F(MavlinkFromRecords, LongTextsGoInPiecesOfWhichTheLastIsNotFull) {
  for (const auto& [severity, number] : {std::pair{"alarm", 2}, {"error", 3}, {"warning", 4}, {"info", 6}}) {
    say("/event", {{"severity", severity}, {"port", "gps"}, {"message", "lost"}});
    EXPECT_EQ(last(kText).at<std::uint8_t>(0), number);
    EXPECT_EQ(last(kText).text(1, 50), "gps: lost");
    EXPECT_EQ(last(kText).at<std::uint16_t>(51), 0);
  }
  for (const std::size_t length : {50U, 51U, 100U, 149U, 5000U}) {
    made.clear();
    std::string joined;
    say("/event", {{"severity", "info"}, {"port", ""}, {"message", std::string(length, 'x')}});
    for (std::size_t i = 0; i < made[kText].size(); ++i) {
      const protocols::mavlink::Payload piece(made[kText][i]);
      EXPECT_EQ(piece.at<std::uint8_t>(53), i);
      EXPECT_EQ(piece.at<std::uint16_t>(51) != 0, length > 50);
      joined += piece.text(1, 50);
      EXPECT_EQ(piece.text(1, 50).size() < 50, length > 50 && i + 1 == made[kText].size());
    }
    EXPECT_EQ(joined.size(), std::min<std::size_t>(length, 1000));
  }
}

// Whatever comes from the socket: no fault, and nothing but whole messages.
TEST_F(MavlinkFromRecords, TakesAnyRecord) {
  for (const char* const text :
       {"", "[]", "1", "{\"lat\":\"x\"}", "{\"velocity_m_s\":[1,2]}", "{\"earth_field\":7}"}) {
    for (const char* const topic : {"/nav", "/time", "/health", "/event"})
      messages.take({topic, "", utc_ns, text}, now);
  }
  EXPECT_TRUE(made[kOdometry].empty());
}

}  // namespace
}  // namespace navcal::web
