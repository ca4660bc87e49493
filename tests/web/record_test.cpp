// SPDX-License-Identifier: Apache-2.0
#include "web/record.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace navcal::web {
namespace {

const std::string kLine =
    R"({"class":"RECORD","topic":"/compass","device":"compass","time":1700000000.123456789,"message":{"heading_rad":1.5,"crc":"00000000"}})";

TEST(Record, MessageAndNanosecondsAreKeptToTheLastDigit) {
  const auto record = read_record(kLine);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->topic, "/compass");
  EXPECT_EQ(record->device, "compass");
  EXPECT_EQ(record->utc_ns, 1'700'000'000'123'456'789);
  EXPECT_EQ(record->message, R"({"heading_rad":1.5,"crc":"00000000"})");
}

TEST(Record, DeviceAndTimeMayBeUnknown) {
  const auto record = read_record(R"({"class":"RECORD","topic":"/event","device":null,"time":null,"message":{}})");
  ASSERT_TRUE(record);
  EXPECT_EQ(record->device, "");
  EXPECT_FALSE(record->utc_ns);
  EXPECT_EQ(record->message, "{}");
  EXPECT_TRUE(read_record(R"({"class":"RECORD","topic":"/event","message":{}})"));
}

TEST(Record, LineEndsAreNotPartOfTheMessage) {
  const std::string line = kLine + "\r\n";
  const auto record = read_record(line);
  ASSERT_TRUE(record);
  EXPECT_TRUE(record->message.ends_with("\"}"));
}

TEST(Record, OtherLinesAreNoRecords) {
  for (const char* line : {"", "{", R"({"class":"TPV"})", R"({"class":"RECORD"})",
                           R"({"class":"RECORD","topic":""})", R"({"class":"RECORD","topic":"/a","message":5})",
                           R"({"class":"RECORD","topic":"/a","time":-1.0,"message":{}})",
                           R"({"class":"RECORD","topic":"/a","time":99999999999.0,"message":{}})",
                           R"({"class":"RECORD","topic":"/a\"b","message":{}})"}) {
    EXPECT_FALSE(read_record(line)) << line;
  }
}

TEST(Record, EveryCutOfALineIsRefused) {
  for (std::size_t n = 0; n < kLine.size(); ++n) EXPECT_FALSE(read_record(kLine.substr(0, n))) << n;
}

TEST(Record, GarbageWithinALineDoesNoHarm) {
  std::mt19937 random(3);
  for (int round = 0; round < 20'000; ++round) {
    std::string line = kLine;
    for (int i = 0; i < 3; ++i) line[random() % line.size()] = static_cast<char>(random() % 256);
    const auto record = read_record(line);
    if (record) {
      EXPECT_TRUE(record->message.starts_with('{') && record->message.ends_with('}')) << line;
    }
  }
}

}  // namespace
}  // namespace navcal::web
