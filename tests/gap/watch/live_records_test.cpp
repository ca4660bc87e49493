// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/live_records.h"

#include <gtest/gtest.h>

#include <string>

#include "base/angles.h"
#include "config/load.h"
#include "config/settings.h"

namespace navcal::gap {
namespace {

constexpr std::string_view kImu =
    R"({"class":"RECORD","topic":"/imu","device":"imu","time":1700000000.125000000,"message":{"class":"IMU","time":1700000000.125000000,"rate_rad_s":[0.1,0.2,0.3],"depth_m":2,"crc":"00000000"}})";
constexpr std::string_view kFix =
    R"({"class":"RECORD","topic":"/gps","device":"gps","time":1700000001.000000000,"message":{"class":"GPS","time":1700000001.000000000,"fix":"3d","lat":59.3,"lon":18.0,"height_m":10,"crc":"00000000"}})";

TEST(LiveRecords, TakesSamplesAndTheFieldOfTheFirstFix) {
  LiveRecords records;
  records.take(kImu, nullptr);
  EXPECT_EQ(records.samples(), 1U);
  EXPECT_FALSE(records.field());
  records.take(kFix, nullptr);
  EXPECT_EQ(records.samples(), 2U);
  ASSERT_TRUE(records.field());
  EXPECT_EQ(records.field()->source, EarthField::Source::model);
  EXPECT_NEAR(records.field()->place->latitude_rad * base::kDegreesPerRadian, 59.3, 1e-9);
  EXPECT_EQ(records.bad(), 0U);
}

TEST(LiveRecords, PassesOverOtherClassesAndCountsWhatTheDaemonLeftOut) {
  LiveRecords records;
  records.take(R"({"class":"VERSION","release":"1"})", nullptr);
  records.take(R"({"class":"HEALTH","dropped":12})", nullptr);
  EXPECT_EQ(records.samples(), 0U);
  EXPECT_EQ(records.bad(), 0U);
  EXPECT_EQ(records.dropped(), 12U);
}

TEST(LiveRecords, CountsLinesThatCannotBeRead) {
  LiveRecords records;
  for (
      const std::string_view line :
      {"", "no JSON", "[1]", R"({"class":"RECORD"})", R"({"class":"RECORD","topic":"/imu"})",
       R"({"class":"RECORD","topic":"/imu","time":-1,"message":{}})",
       R"({"class":"RECORD","topic":"/imu","time":1e300,"message":{}})",
       R"({"class":"RECORD","topic":"/imu","time":1700000000,"message":7})",
       R"({"class":"RECORD","topic":"/imu","time":1700000000,"message":{"class":"IMU","depth_m":"deep"}})",
       R"({"class":"RECORD","topic":"/command","time":1,"message":{"sent":1e300,"shaft_sent_rpm":1,"fins_sent_deg":[0,0,0]}})",
       R"({"class":["RECORD"]})"}) {
    const std::uint64_t before = records.bad();
    records.take(line, nullptr);
    EXPECT_EQ(records.bad(), before + 1) << line;
  }
  for (std::size_t length = 0; length < kImu.size(); ++length) records.take(kImu.substr(0, length), nullptr);
  EXPECT_EQ(records.samples(), 0U);
  records.take(kImu, nullptr);
  EXPECT_EQ(records.samples(), 1U);
}

TEST(LiveRecords, GivesSamplesThePortOfTheirDeviceAndCountsThoseOfNone) {
  config::Settings settings;
  for (const std::string name : {"gps", "imu"})
    settings.ports.push_back(config::default_port(name, protocols::Protocol::samples, 115200));
  LiveRecords records(settings);
  records.take(kImu, nullptr);
  EXPECT_EQ(records.samples(), 1U);
  std::string other(kImu);
  other.replace(other.find(R"("device":"imu")"), 14, R"("device":"xxx")");
  records.take(other, nullptr);
  EXPECT_EQ(records.samples(), 1U);
  EXPECT_EQ(records.bad(), 1U);
}

}  // namespace
}  // namespace navcal::gap
