// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "web/page_feed.h"

namespace navcal::web {
namespace {

using Json = nlohmann::json;

const PageState::Time kNow{};

Json news(PageState& state) {
  std::string text;
  state.append_news(text);
  return Json::parse(text);
}

Json all(const PageState& state, PageState::Time now = kNow) {
  std::string text = "{";
  state.append_all(text, now);
  return Json::parse(text + "}");
}

TEST(PageState, TellsTheNewestOfEachTopicAndDeviceOnce) {
  PageState state;
  state.take({"/imu", "a", {}, R"({"n":1})"}, kNow);
  state.take({"/imu", "b", {}, R"({"n":2})"}, kNow);
  state.take({"/imu", "a", {}, R"({"n":3})"}, kNow);
  state.take({"/time", "", {}, R"({"n":4})"}, kNow);
  EXPECT_TRUE(state.has_news());
  EXPECT_EQ(news(state), Json::parse(R"([["/imu","a",{"n":3}],["/imu","b",{"n":2}],["/time",null,{"n":4}]])"));
  EXPECT_FALSE(state.has_news());
  EXPECT_EQ(news(state), Json::array());
  state.take({"/imu", "b", {}, R"({"n":5})"}, kNow);
  EXPECT_EQ(news(state), Json::parse(R"([["/imu","b",{"n":5}]])"));
}

TEST(PageState, TellsEveryEvent) {
  PageState state;
  for (int i = 0; i < 3; ++i) state.take({"/event", "", {}, fmt::format(R"({{"n":{}}})", i)}, kNow);
  EXPECT_EQ(news(state).size(), 3U);
  for (int i = 3; i < 500; ++i) state.take({"/event", "", {}, fmt::format(R"({{"n":{}}})", i)}, kNow);
  const Json events = all(state)["events"];
  ASSERT_EQ(events.size(), PageState::kMaxEvents);
  EXPECT_EQ(events.front()["n"], 300);
  EXPECT_EQ(events.back()["n"], 499);
}

TEST(PageState, KeepsThePartsOfAReportAndTheQuantitiesOfASensor) {
  PageState state;
  state.take({"/health", "", {}, R"({"part":1,"parts":2})"}, kNow);
  state.take({"/health", "", {}, R"({"part":2,"parts":2})"}, kNow);
  state.take({"/sensor", "ctd", {}, R"({"quantity":"conductivity"})"}, kNow);
  state.take({"/sensor", "ctd", {}, R"({"quantity":"temperature"})"}, kNow);
  state.take({"/sensor", "ctd", {}, R"({"quantity":"temperature"})"}, kNow);
  EXPECT_EQ(news(state).size(), 4U);
  EXPECT_EQ(all(state)["records"].size(), 4U);
}

TEST(PageState, OneBadMessageSpoilsNothing) {
  PageState state;
  for (const char* const bad : {R"({"a":)", "", "{\"a\":\"\xFF\"}", R"({"a":1}])", R"({"a":NaN})"})
    state.take({"/imu", "a", {}, bad}, kNow);
  EXPECT_EQ(state.left_out(), 5U);
  EXPECT_FALSE(state.has_news());
  state.take({"/imu", "a", {}, R"({"a":1})"}, kNow);
  EXPECT_EQ(news(state).size(), 1U);
}

TEST(PageState, StateOfTheCalibratorsIsNotForThePage) {
  PageState state;
  state.take({"/calib", "", {}, R"({"class":"CALIB","name":"none"})"}, kNow);
  state.take({"/calib", "", {}, R"({"class":"CALIBRATION","state":"AAAA"})"}, kNow);
  EXPECT_EQ(news(state), Json::parse(R"([["/calib",null,{"class":"CALIB","name":"none"}]])"));
}

TEST(PageState, AgesCountFromWhenARecordCame) {
  PageState state;
  state.take({"/imu", "a", {}, "{}"}, kNow);
  const Json records = all(state, kNow + std::chrono::seconds(7))["records"];
  EXPECT_EQ(records[0][3], 7.0);
}

TEST(PageState, IsBoundedWhateverDevicesAPeerNames) {
  PageState state;
  for (int i = 0; i < 2000; ++i) state.take({"/imu", fmt::format("d{}", i), {}, "{}"}, kNow);
  EXPECT_EQ(all(state)["records"].size(), PageState::kMaxRecords);
}

TEST(PageState, TrackAndFixesHaveTheirStandardErrors) {
  PageState state;
  state.take({"/nav", "", 10'000'000'000, R"({"lat":59.5,"lon":18.25,"north_std_m":1.5,"east_std_m":2.5})"}, kNow);
  state.take({"/nav", "", 11'000'000'000, R"({"lat":null,"lon":null})"}, kNow);
  state.take({"/gps", "gps", 10'000'000'000, R"({"lat":59,"lon":18,"position_std_m":null})"}, kNow);
  const Json whole = all(state);
  EXPECT_EQ(whole["track"], Json::parse("[[10.0,59.5,18.25,1.5,2.5]]"));
  EXPECT_EQ(whole["fixes"], Json::parse("[[10.0,59.0,18.0,null,null]]"));
  state.clear();
  EXPECT_EQ(all(state), Json::parse(R"({"records":[],"events":[],"track":[],"fixes":[]})"));
}

TEST(PageTrack, IsBoundedAndReachesFromTheFirstToTheLast) {
  PageTrack track;
  for (int i = 0; i < 100'000; ++i) track.add({static_cast<double>(i), 59, 18, -1, -1});
  const auto& points = track.points();
  EXPECT_LE(points.size(), PageTrack::kMaxPoints);
  EXPECT_GE(points.size(), PageTrack::kMaxPoints / 2 - 1);
  EXPECT_EQ(points.front().time_s, 0);
  EXPECT_GT(points.back().time_s, 99'900);
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LT(points[i - 1].time_s, points[i].time_s);
}

TEST(PageTrack, BeginsAnewWhenTimeGoesBack) {
  PageTrack track;
  track.add({1000, 59, 18, -1, -1});
  track.add({1000.5, 59, 18, -1, -1});  // too near
  track.add({5, 59, 18, -1, -1});
  ASSERT_EQ(track.points().size(), 1U);
  EXPECT_EQ(track.points().front().time_s, 5);
}

}  // namespace
}  // namespace navcal::web
