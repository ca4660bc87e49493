// SPDX-License-Identifier: Apache-2.0
// Ports of NMEA 0183: the time of an epoch whose sentences take long, and sentences that nothing reads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/durations.h"
#include "pipeline/pipeline.h"
#include "protocols/checked_line.h"

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kNmeaOffset_ns = 1772366400 * base::kSecond_ns;  // of UTC from monotonic: 2026-03-01 12:00
constexpr int kNmeaBaud = 9600;

struct NmeaOutput : Sink {
  void on_sample(const instruments::Sample& sample) override { samples.push_back(sample); }
  void on_mapping(const UtcMapping& mapping) override { mappings.push_back(mapping); }
  std::vector<instruments::Sample> samples;
  std::vector<UtcMapping> mappings;
};

config::Settings one_receiver() {
  config::Settings settings;
  auto& port = settings.ports.emplace_back();
  port.name = "gps";
  port.baud = kNmeaBaud;
  port.latency_std_s = 0.05;
  return settings;
}

/// The bytes pass the line from `begin_ns` on and are read sixteen at a time.
void send_line(Pipeline& pipeline, std::int64_t begin_ns, protocols::Bytes bytes, Sink& sink) {
  for (std::size_t at = 0; at < bytes.size(); at += 16) {
    const auto piece = bytes.subspan(at, std::min<std::size_t>(16, bytes.size() - at));
    const auto passed_ns = static_cast<std::int64_t>(at + piece.size()) * 10 * base::kSecond_ns / kNmeaBaud;
    pipeline.bytes(0, begin_ns + passed_ns, piece, sink);
  }
}

void append_sentence(std::vector<std::uint8_t>& out, const std::string& body) {
  const auto line = protocols::checked_line(body);
  out.insert(out.end(), line.begin(), line.end());
}

/// The receiver begins to send so many milliseconds after its second.
class NmeaPortDelay : public testing::TestWithParam<int> {};

TEST_P(NmeaPortDelay, AnEpochIsOfTheTimeOfItsFirstSentence) {
  const std::int64_t delay_ns = GetParam() * base::kMillisecond_ns;
  Pipeline pipeline(one_receiver());
  NmeaOutput seen;
  for (int s = 10; s < 50; ++s) {
    const std::string time = fmt::format("1200{}.00", s), place = "3844.1200,N,00908.4000,W";
    std::vector<std::uint8_t> burst;
    append_sentence(burst, "GNGGA," + time + "," + place + ",1,14,0.8,60.0,M,48.0,M,,");
    for (int i = 1; i <= 9; ++i)
      append_sentence(burst, fmt::format("GPGSV,9,{},36,01,41,083,40,02,42,084,41,03,43,085,42,04,44,086,43", i));
    append_sentence(burst, "GNRMC," + time + ",A," + place + ",1.2,75.0,010326,,,A");
    ASSERT_GT(burst.size() * 10 * base::kSecond_ns / kNmeaBaud, 700 * base::kMillisecond_ns);
    send_line(pipeline, s * base::kSecond_ns + delay_ns, burst, seen);
  }
  ASSERT_FALSE(seen.mappings.empty());
  for (const UtcMapping& mapping : seen.mappings) {
    EXPECT_LE(std::abs(mapping.offset_ns - kNmeaOffset_ns), mapping.bound_ns);
    EXPECT_NEAR(static_cast<double>(kNmeaOffset_ns - mapping.offset_ns) * 1e-9, GetParam() * 1e-3, 0.02);
  }
  const auto fix = std::find_if(seen.samples.rbegin(), seen.samples.rend(), [](const auto& sample) {
    return std::holds_alternative<instruments::GpsSample>(sample.value);
  });
  ASSERT_NE(fix, seen.samples.rend());
  EXPECT_NEAR(static_cast<double>(fix->stamp.validity_ns) * 1e-9, 49 + GetParam() * 1e-3, 0.02);
  EXPECT_GT(fix->stamp.arrival_ns - fix->stamp.validity_ns, 700 * base::kMillisecond_ns);
}

INSTANTIATE_TEST_SUITE_P(Usual, NmeaPortDelay, testing::Values(50, 150, 400));

/// A second of a receiver that sends RMC and GGA 0.2 s behind it.
void send_second(Pipeline& pipeline, std::int64_t second_ns, const std::string& time, const std::string& date,
                 Sink& sink) {
  const std::string place = "3844.1200,N,00908.4000,W";
  std::vector<std::uint8_t> burst;
  append_sentence(burst, "GNRMC," + time + ".00,A," + place + ",1.2,75.0," + date + ",,,A");
  append_sentence(burst, "GNGGA," + time + ".00," + place + ",1,14,0.8,60.0,M,48.0,M,,");
  send_line(pipeline, second_ns + 200 * base::kMillisecond_ns, burst, sink);
}

TEST(NmeaPort, TheBoundOfUtcHoldsAcrossALeapSecond) {
  constexpr std::int64_t kMidnight_ns = 1'798'761'600 * base::kSecond_ns;  // 2027-01-01
  Pipeline pipeline(one_receiver());
  NmeaOutput seen;
  for (int k = -30; k < 30; ++k) {  // 0 is 23:59:60
    const std::int64_t second_ns = (100 + k) * base::kSecond_ns;
    const std::int64_t utc_ns = kMidnight_ns + (k > 0 ? k - 1 : k) * base::kSecond_ns;
    const auto holds = [&](std::int64_t after_ns) {
      const UtcMapping& mapping = pipeline.mapping();
      EXPECT_LE(std::abs(mapping.to_utc(second_ns + after_ns) - utc_ns - after_ns), mapping.bound_ns) << k;
    };
    holds(0);
    const std::string time = k < 0   ? fmt::format("2359{}", 60 + k)
                             : k > 0 ? fmt::format("0000{:02}", k - 1)
                                     : "235960";
    send_second(pipeline, second_ns, time, k > 0 ? "010127" : "311226", seen);
    holds(900 * base::kMillisecond_ns);
  }
  EXPECT_EQ(pipeline.mapping().source, UtcMapping::Source::gps);
  EXPECT_LT(pipeline.mapping().bound_ns, base::kSecond_ns);
}

TEST(NmeaPort, ADateOfAReceiverThatHasNotFoundTheTimeIsNone) {
  for (const char* date : {"060180", "050180", "010180", "140280", "220899", "210899"}) {
    Pipeline pipeline(one_receiver());
    NmeaOutput seen;
    for (int s = 10; s < 40; ++s)
      send_second(pipeline, s * base::kSecond_ns, fmt::format("0000{}", s), date, seen);
    EXPECT_TRUE(seen.mappings.empty()) << date;
    ASSERT_FALSE(seen.samples.empty());
    EXPECT_FALSE(std::get<instruments::GpsSample>(seen.samples.back().value).time_utc_ns) << date;
    for (int s = 40; s < 60; ++s)
      send_second(pipeline, s * base::kSecond_ns, fmt::format("1200{}", s), "010326", seen);
    EXPECT_EQ(pipeline.mapping().source, UtcMapping::Source::gps) << "once it has found it";
  }
}

TEST(NmeaPort, SentencesThatNothingReadsAreCountedByKind) {
  Pipeline pipeline(one_receiver());
  NmeaOutput seen;
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 5; ++i) append_sentence(bytes, "PXYZA,1,2");
  append_sentence(bytes, "SDDBT,,f,12.5,M,,F");
  append_sentence(bytes, "HEHDT,,T");
  send_line(pipeline, 0, bytes, seen);
  EXPECT_EQ(pipeline.statistics(0).unused.total(), 6U);
  EXPECT_EQ(pipeline.statistics(0).unused.words(), "PXYZA 5, HEHDT 1");
  EXPECT_EQ(pipeline.statistics(0).samples, 1U);
  bytes.clear();
  for (int i = 0; i < 10; ++i) append_sentence(bytes, fmt::format("PXYZ{}", i));
  send_line(pipeline, base::kSecond_ns, bytes, seen);
  EXPECT_EQ(pipeline.statistics(0).unused.words(),
            "PXYZA 5, HEHDT 1, PXYZ0 1, PXYZ1 1, PXYZ2 1, PXYZ3 1, PXYZ4 1, PXYZ5 1, others 4");
}

TEST(NmeaPort, ADeviceWithoutChecksumsIsTakenWhereTheConfigurationSaysSo) {
  const std::string text = "$SDDBT,,f,12.5,M,,F\r\n";
  const protocols::Bytes bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  for (const bool required : {true, false}) {
    config::Settings settings = one_receiver();
    settings.ports[0].require_checksum = required;
    Pipeline pipeline(settings);
    NmeaOutput seen;
    send_line(pipeline, 0, bytes, seen);
    EXPECT_EQ(pipeline.statistics(0).samples, required ? 0U : 1U);
  }
}

}  // namespace
}  // namespace navcal::pipeline
