// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "record/capture/capture_reader.h"
#include "record/capture/capture_writer.h"
#include "tests/record/memory_source.h"
#include "tests/record/sample_log.h"

namespace navcal::record {
namespace {

const std::string kHead = "#capture 1\n#port compass tcm2 38400\n#port imu imu-card 57600\n";

CaptureReader reader_of(std::string_view text) { return {std::make_unique<MemorySource>(text), "x.cap"}; }

std::vector<RawRead> read_all(CaptureReader& reader) {
  std::vector<RawRead> reads;
  for (RawRead read; reader.next(read);) reads.push_back(read);
  return reads;
}

std::string error_of(std::string_view text) {
  try {
    CaptureReader reader = reader_of(text);
    read_all(reader);
  } catch (const BadRecording& error) {
    return error.what();
  }
  return "no error";
}

TEST(Capture, ReadsTheExampleOfTheInterfaceDocument) {
  const std::string text = kHead +
                           "1700000000.125003881 imu < a55a0700\n# comment\n#event 3 dive begins\n"
                           "1700000000.131775000 compass < 2443310d0a\n1700000001.000012345 compass > 683d0d\n";
  CaptureReader reader = reader_of(text);
  ASSERT_EQ(reader.ports().size(), 2U);
  EXPECT_EQ(reader.ports()[1].protocol, protocols::Protocol::imu_card);
  EXPECT_EQ(reader.ports()[1].baud, 57600);
  const auto reads = read_all(reader);
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_EQ(reads[0].time_ns, 1'700'000'000'125'003'881);
  EXPECT_EQ(reads[0].port, 1);
  EXPECT_EQ(reads[0].bytes, (std::vector<std::uint8_t>{0xA5, 0x5A, 0x07, 0x00}));
  EXPECT_EQ(reads[2].direction, Direction::sent);
  EXPECT_TRUE(reader.remarks().empty());
}

TEST(Capture, OutputsOfALayoutAreDescribedAndOtherDevicesAreNot) {
  const CaptureReader reader = reader_of("#capture 1\n#port outputs described 9600\n#port ctd described 9600\n");
  ASSERT_EQ(reader.ports().size(), 2U);
  ASSERT_TRUE(reader.ports()[0].described);
  EXPECT_EQ(reader.ports()[0].described->name, "actuator outputs");
  EXPECT_EQ(reader.ports()[0].baud, 9600);
  EXPECT_FALSE(reader.ports()[1].described);
}

TEST(Capture, WhatIsWrittenReadsBack) {
  std::mt19937 random(5);
  const auto settings = testing::sample_settings();
  CaptureWriter writer(settings.ports);
  std::string text;
  writer.begin(text);
  std::vector<RawRead> expected;
  std::int64_t at = 1'700'000'000'000'000'000;
  for (int i = 0; i < 300; ++i) {
    RawRead read{
        static_cast<std::uint16_t>(random() % 2), static_cast<Direction>(random() % 2), at += random(), {}};
    read.bytes.resize(1 + random() % (i % 50 == 0 ? 4096 : 60));
    for (auto& byte : read.bytes) byte = static_cast<std::uint8_t>(random());
    writer.bytes(text, read.port, read.direction, read.time_ns, read.bytes);
    expected.push_back(read);
  }
  CaptureReader reader = reader_of(text);
  const auto reads = read_all(reader);
  ASSERT_EQ(reads.size(), expected.size());
  for (std::size_t i = 0; i < reads.size(); ++i) {
    EXPECT_EQ(reads[i].time_ns, expected[i].time_ns);
    EXPECT_EQ(reads[i].port, expected[i].port);
    EXPECT_EQ(reads[i].direction, expected[i].direction);
    EXPECT_EQ(reads[i].bytes, expected[i].bytes);
  }
}

TEST(Capture, ACutAtEveryByteKeepsAllThatCameBefore) {
  std::string text = kHead;
  for (int i = 0; i < 20; ++i) text += "17000000" + std::to_string(10 + i) + ".000000000 imu < a55a0700\n";
  for (std::size_t cut = kHead.size(); cut < text.size(); ++cut) {
    const auto cut_text = std::string_view(text).substr(0, cut);
    CaptureReader reader = reader_of(cut_text);
    const auto lines = static_cast<std::size_t>(std::count(cut_text.begin(), cut_text.end(), '\n'));
    ASSERT_EQ(read_all(reader).size(), lines - 3) << cut;
    ASSERT_EQ(reader.remarks().size(), cut_text.back() == '\n' ? 0U : 1U);
    if (!reader.remarks().empty()) {
      EXPECT_EQ(reader.remarks()[0], "x.cap:" + std::to_string(lines + 1) + ": last line cut short: left out");
    }
  }
}

TEST(Capture, MarksAreGivenBetweenTheReadsWhereTheyStand) {
  CaptureReader reader = reader_of(kHead +
                                   "#event head\n1.000000000 imu < a5\n#event one\n# no mark\n#event two\n"
                                   "2.000000000 imu < a5\n#event end\n");
  using Texts = std::vector<std::string>;
  RawRead read;
  EXPECT_EQ(reader.take_events(), Texts{"head"});
  ASSERT_TRUE(reader.next(read));
  EXPECT_EQ(reader.take_events(), (Texts{"one", "two"}));
  ASSERT_TRUE(reader.next(read));
  EXPECT_EQ(reader.take_events(), Texts{"end"});
  EXPECT_FALSE(reader.next(read));
  EXPECT_EQ(reader.take_events(), Texts{});
}

TEST(Capture, LongReadsAreSplitAndTimeNeverGoesBack) {
  const auto settings = testing::sample_settings();
  CaptureWriter writer(settings.ports);
  std::string text;
  writer.begin(text);
  writer.bytes(text, 0, Direction::received, 2'000'000'000, std::vector<std::uint8_t>(9000, 7));
  writer.bytes(text, 0, Direction::received, 1'000'000'000, std::vector<std::uint8_t>(1, 8));
  EXPECT_EQ(writer.raised(), 1U);
  CaptureReader reader = reader_of(text);
  const auto reads = read_all(reader);
  ASSERT_EQ(reads.size(), 4U);
  EXPECT_EQ(reads[2].bytes.size(), 9000U - 2 * 4096U);
  EXPECT_EQ(reads[3].time_ns, 2'000'000'000);
}

TEST(Capture, ErrorsNameFileLineAndReason) {
  const std::string at4 = "x.cap:4: ";
  const auto cr_lf_at = [](int line) {
    return "x.cap:" + std::to_string(line) +
           ": line ends in CR LF; a capture's lines end in LF alone (sed 's/\\r$//' FILE converts it)";
  };
  const std::string good = "1700000000.125003881 imu < a55a\n";
  EXPECT_EQ(error_of(""), "x.cap:0: empty: a capture begins with \"#capture 1\"");
  EXPECT_EQ(error_of("hello\n"), "x.cap:1: a capture begins with \"#capture 1\"");
  EXPECT_EQ(error_of("#capture 2\n"), "x.cap:1: this version of captures is not known; 1 is");
  EXPECT_EQ(error_of("#capture 1\r\n"), cr_lf_at(1));
  EXPECT_EQ(error_of(kHead + "\n"), at4 + "empty line");
  EXPECT_EQ(error_of(kHead + "1700000000.125 imu < a5\n"), at4 + "expected UTC seconds with nine decimals");
  EXPECT_EQ(error_of(kHead + "-1.000000000 imu < a5\n"), at4 + "expected UTC seconds with nine decimals");
  EXPECT_EQ(error_of(kHead + "99999999999.000000000 imu < a5\n"), at4 + "expected UTC seconds with nine decimals");
  EXPECT_EQ(error_of(kHead + "1.000000000 gps < a5\n"), at4 + "no \"#port\" line names this port");
  EXPECT_EQ(error_of(kHead + "1.000000000 imu = a5\n"),
            at4 + "expected \"STAMP PORT < BYTES\", or \">\" for bytes sent");
  const std::string bytes = at4 + "expected 1 to 4096 bytes of two hexadecimal digits each";
  EXPECT_EQ(error_of(kHead + "1.000000000 imu <\n"), bytes);
  EXPECT_EQ(error_of(kHead + "1.000000000 imu < a\n"), bytes);
  EXPECT_EQ(error_of(kHead + "1.000000000 imu < " + std::string(8194, 'a') + "\n"), bytes);
  EXPECT_EQ(error_of(kHead + "1.000000000 imu < A5\n"), at4 + "bytes must be lower-case hexadecimal");
  EXPECT_EQ(error_of(kHead + "1.000000000 imu < a5 5\n"), at4 + "bytes must be lower-case hexadecimal");
  EXPECT_EQ(error_of(kHead + "1.000000000 imu < a5\r\n"), cr_lf_at(4));
  EXPECT_EQ(error_of(kHead + "\r\n"), cr_lf_at(4));
  EXPECT_EQ(error_of(kHead + good + "1.000000000 imu < a5\n"), "x.cap:5: time goes backwards");
  EXPECT_EQ(error_of(kHead + good + "#port gps oncore 9600\n" + good),
            "x.cap:5: a port line behind the first line with bytes");
  const std::string protocol = error_of(kHead + "#port gps tcm3 9600\n");
  EXPECT_TRUE(protocol.starts_with(at4 + "protocol must be one of tcm2, ")) << protocol;
  EXPECT_NE(protocol.find(", ubx"), std::string::npos) << protocol;
  EXPECT_EQ(error_of(kHead + "#port gps oncore fast\n"), at4 + "speed must be a number of 1 to 4000000 baud");
  EXPECT_EQ(error_of(kHead + "#port ../gps oncore 9600\n"), at4 + "a port's name is 1 to 31 of a-z, 0-9, _ and -");
  EXPECT_EQ(error_of(kHead + "#port imu oncore 9600\n"), at4 + "the port is named a second time");
  EXPECT_EQ(error_of(kHead + std::string(70'000, '#') + "\n"), at4 + "line is longer than 65535 bytes");
}

}  // namespace
}  // namespace navcal::record
