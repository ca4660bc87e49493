// SPDX-License-Identifier: Apache-2.0
#include "pipeline/pipeline.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "base/durations.h"
#include "config/load.h"
#include "protocols/imu_card.h"
#include "protocols/oncore_encode.h"

namespace navcal::pipeline {
namespace {

struct Read {
  std::uint16_t port;
  std::int64_t arrival_ns;
  std::vector<std::uint8_t> bytes;
};

struct Recorder : Sink {
  void on_sample(const instruments::Sample& sample) override { samples.push_back(sample); }
  void on_frame(std::uint16_t, const protocols::Frame&, std::int64_t) override { ++frames; }
  void on_mapping(const UtcMapping& mapping) override { mappings.push_back(mapping); }
  std::vector<instruments::Sample> samples;
  std::vector<UtcMapping> mappings;
  int frames = 0;
};

bool same(const instruments::Stamp& a, const instruments::Stamp& b) {
  return a.arrival_ns == b.arrival_ns && a.validity_ns == b.validity_ns && a.std_ns == b.std_ns &&
         a.arrival_utc_ns == b.arrival_utc_ns && a.validity_utc_ns == b.validity_utc_ns;
}

config::Settings imu_and_gps() {
  config::Settings settings;
  auto& imu = settings.ports.emplace_back();
  imu.name = "imu";
  imu.protocol = protocols::Protocol::imu_card;
  imu.baud = 57600;
  imu.latency_s = 0.025;
  imu.rate_Hz = 20;
  auto& gps = settings.ports.emplace_back();
  gps.name = "gps";
  gps.protocol = protocols::Protocol::oncore;
  gps.baud = 9600;
  gps.latency_s = 0.3;
  gps.latency_std_s = 0.02;
  gps.rate_Hz = 1;
  return settings;
}

std::vector<std::uint8_t> imu_frame(int k) {
  protocols::imu_card::Record record;
  record.sequence = static_cast<std::uint8_t>(k);
  record.raw[1] = static_cast<std::uint16_t>(k * 7);
  const auto frame = protocols::imu_card::encode_record(record);
  return {frame.begin(), frame.end()};
}

std::vector<std::uint8_t> gps_frame(int second) {
  protocols::oncore::Position p;
  p.date = {2026, 3, 1};
  p.time = {12, static_cast<std::uint8_t>(second / 60), static_cast<std::uint8_t>(second % 60), 0};
  p.filtered = {57.7, 12.0, 3.0, std::nullopt};
  p.fix = protocols::Fix::fix_3d;
  p.channel_count = 8;
  return protocols::oncore::encode_ea(p);
}
constexpr std::int64_t kGpsZeroUtc_ns = 1772366400 * base::kSecond_ns;

/// Two instruments over `seconds`, read in pieces with delays; some GPS messages lose their tail.
std::vector<Read> stream(unsigned seed, int seconds) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> delay_ms(0.5);
  std::vector<Read> reads;
  std::array<std::int64_t, 2> newest_ns{};  // bytes of one port arrive in order
  const auto cut_up = [&](std::uint16_t port, std::int64_t first_ns, std::int64_t byte_ns,
                          std::vector<std::uint8_t> bytes) {
    for (std::size_t begin = 0; begin < bytes.size();) {
      const std::size_t n = std::min<std::size_t>(1 + random() % 40, bytes.size() - begin);
      const auto end_ns = first_ns + static_cast<std::int64_t>(begin + n) * byte_ns;
      newest_ns[port] = std::max<std::int64_t>(newest_ns[port], end_ns + std::llround(delay_ms(random) * 1e6));
      reads.push_back({port,
                       newest_ns[port],
                       {bytes.begin() + static_cast<long>(begin), bytes.begin() + static_cast<long>(begin + n)}});
      begin += n;
    }
  };
  for (int k = 0; k < 20 * seconds; ++k)
    cut_up(0, 10 * base::kSecond_ns + k * 50 * base::kMillisecond_ns + 25 * base::kMillisecond_ns, 173'611,
           imu_frame(k));
  for (int s = 0; s < seconds; ++s) {
    auto frame = s == 2 ? protocols::oncore::encode_bo({std::int8_t{18}}) : gps_frame(s);
    if (random() % 5 == 0) frame.resize(frame.size() / 2);
    cut_up(1, 10 * base::kSecond_ns + s * base::kSecond_ns + 300 * base::kMillisecond_ns, 1'041'666, frame);
  }
  std::stable_sort(reads.begin(), reads.end(),
                   [](const Read& a, const Read& b) { return a.arrival_ns < b.arrival_ns; });
  return reads;
}

TEST(Pipeline, TheSameBytesAtTheSameStampsGiveTheSameSamplesWhetherTimersRanOrNot) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto reads = stream(seed, 30);
    Recorder live, replay;
    Pipeline a(imu_and_gps()), b(imu_and_gps());
    std::mt19937 random(seed + 100);
    for (const auto& read : reads) {
      // Live, timers call now and then; sometimes late, sometimes not at all before the next read.
      while (a.next_deadline_ns() < read.arrival_ns && random() % 2 == 0) {
        a.advance(std::min(read.arrival_ns,
                           a.next_deadline_ns() + static_cast<std::int64_t>(random() % 3) * base::kMillisecond_ns),
                  live);
      }
      a.bytes(read.port, read.arrival_ns, read.bytes, live);
      b.bytes(read.port, read.arrival_ns, read.bytes, replay);
    }
    ASSERT_EQ(live.samples.size(), replay.samples.size());
    for (std::size_t i = 0; i < live.samples.size(); ++i) {
      ASSERT_EQ(live.samples[i].port, replay.samples[i].port);
      ASSERT_TRUE(same(live.samples[i].stamp, replay.samples[i].stamp)) << i;
    }
    EXPECT_EQ(live.mappings.size(), replay.mappings.size());
  }
}

TEST(Pipeline, EveryByteIsAccountedForAndIntactFramesSurviveTornOnes) {
  const auto reads = stream(3, 60);
  Pipeline pipeline(imu_and_gps());
  Recorder recorder;
  std::array<std::uint64_t, 2> sent{};
  for (const auto& read : reads) {
    sent[read.port] += read.bytes.size();
    pipeline.bytes(read.port, read.arrival_ns, read.bytes, recorder);
  }
  pipeline.advance(1000 * base::kSecond_ns, recorder);
  for (std::uint16_t port = 0; port < 2; ++port) {
    const auto statistics = pipeline.statistics(port);
    EXPECT_EQ(statistics.bytes.bytes, sent[port]);
    EXPECT_EQ(statistics.bytes.framed_bytes + statistics.bytes.skipped_bytes + statistics.held_bytes, sent[port]);
    EXPECT_EQ(statistics.held_bytes, 0U);
  }
  EXPECT_EQ(pipeline.statistics(0).samples, 1200U);
  EXPECT_EQ(pipeline.statistics(0).lost, 0U);
  EXPECT_GT(pipeline.statistics(1).silences, 0U);
  EXPECT_EQ(pipeline.next_deadline_ns(), std::numeric_limits<std::int64_t>::max());
}

TEST(Pipeline, ATornFrameDoesNotDelayTheNextOne) {
  Pipeline pipeline(imu_and_gps());
  Recorder recorder;
  auto torn = gps_frame(0);
  torn.resize(20);
  pipeline.bytes(1, 1 * base::kSecond_ns, torn, recorder);
  EXPECT_LT(pipeline.next_deadline_ns(), 1 * base::kSecond_ns + 500 * base::kMillisecond_ns);
  pipeline.bytes(1, 2 * base::kSecond_ns, gps_frame(1), recorder);
  EXPECT_EQ(recorder.samples.size(), 1U);
  EXPECT_EQ(recorder.samples[0].stamp.arrival_ns, 2 * base::kSecond_ns);
}

TEST(Pipeline, AFrameOfWhichTheHostReadsTheRestLateIsStillWhole) {
  Pipeline pipeline(imu_and_gps());
  Recorder recorder;
  const auto frame = imu_frame(0);
  const protocols::Bytes bytes(frame);
  pipeline.bytes(0, 1 * base::kSecond_ns, bytes.first(16), recorder);
  pipeline.advance(1 * base::kSecond_ns + 200 * base::kMillisecond_ns, recorder);
  pipeline.bytes(0, 1 * base::kSecond_ns + 200 * base::kMillisecond_ns, bytes.subspan(16), recorder);
  EXPECT_EQ(recorder.samples.size(), 1U);
}

TEST(Pipeline, StampsAreWithinAFractionOfAMillisecondOfTheTruth) {
  const auto reads = stream(5, 60);
  Pipeline pipeline(imu_and_gps());
  Recorder recorder;
  for (const auto& read : reads) pipeline.bytes(read.port, read.arrival_ns, read.bytes, recorder);
  int k = 0;
  for (const auto& sample : recorder.samples) {
    if (sample.port != 0) continue;
    if (k > 40) {
      EXPECT_NEAR(
          static_cast<double>(sample.stamp.validity_ns - 10 * base::kSecond_ns - k * 50 * base::kMillisecond_ns),
          0, 0.4e6);
    }
    EXPECT_LE(sample.stamp.validity_ns, sample.stamp.arrival_ns);
    ++k;
  }
}

TEST(Pipeline, GpsTimeBecomesTheMappingAndStatesItsOwnSecond) {
  Pipeline pipeline(imu_and_gps());
  Recorder recorder;
  pipeline.set_mapping({UtcMapping::Source::system, 5, UtcMapping::kUnknownBound, 0}, recorder);
  for (int s = 0; s < 40; ++s) {
    const auto frame = s == 2 ? protocols::oncore::encode_bo({std::int8_t{18}}) : gps_frame(s);
    const auto wire_ns = static_cast<std::int64_t>(frame.size()) * 1'041'666;
    pipeline.bytes(1, 100 * base::kSecond_ns + s * base::kSecond_ns + 300 * base::kMillisecond_ns + wire_ns, frame,
                   recorder);
  }
  EXPECT_EQ(pipeline.mapping().source, UtcMapping::Source::gps);
  EXPECT_NEAR(static_cast<double>(pipeline.mapping().offset_ns - (kGpsZeroUtc_ns - 100 * base::kSecond_ns)), 0,
              5e6);
  EXPECT_EQ(recorder.samples.back().stamp.validity_utc_ns, kGpsZeroUtc_ns + 39 * base::kSecond_ns);
  EXPECT_GE(recorder.mappings.size(), 2U);
}

/// The position of a receiver whose sentence has this date, noon UTC, in a recording with this mapping.
instruments::GpsSample position_of(const std::string& ddmmyy, UtcMapping::Source source,
                                   std::int64_t arrival_utc_ns) {
  config::Settings settings;
  settings.ports.push_back(config::default_port("gps", protocols::Protocol::nmea, 4800));
  Pipeline pipeline(settings);
  Recorder recorder;
  pipeline.set_mapping({source, 0, 0, 0}, recorder);
  const std::string body = "GPRMC,120000.00,A,4330.0000,N,07012.0000,W,2.00,90.0," + ddmmyy + ",,,A";
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  const std::string line = fmt::format("${}*{:02X}\r\n", body, sum);
  pipeline.bytes(0, arrival_utc_ns, {reinterpret_cast<const std::uint8_t*>(line.data()), line.size()}, recorder);
  return std::get<instruments::GpsSample>(recorder.samples.at(0).value);
}

TEST(Pipeline, AnOldDateStandsWhereTheTimesOfTheFileAgree) {
  constexpr std::int64_t kNoon2015_ns = 1'433'160'000 * base::kSecond_ns;  // 2015-06-01T12:00:00Z
  constexpr std::int64_t kEpoch_ns = 1024LL * 7 * 86'400 * base::kSecond_ns;
  constexpr auto kLate_ns = 300 * base::kMillisecond_ns;
  const auto kept = position_of("010615", UtcMapping::Source::file, kNoon2015_ns + kLate_ns);
  EXPECT_EQ(kept.time_utc_ns, kNoon2015_ns);
  EXPECT_FALSE(kept.time_corrected);
  // The file is of the date that the rolled-over receiver means; the file's clock says nothing; and live.
  for (const auto& found : {position_of("010615", UtcMapping::Source::file, kNoon2015_ns + kEpoch_ns + kLate_ns),
                            position_of("010615", UtcMapping::Source::file, kLate_ns),
                            position_of("010615", UtcMapping::Source::system, kNoon2015_ns + kLate_ns)}) {
    EXPECT_EQ(found.time_utc_ns, kNoon2015_ns + kEpoch_ns);
    EXPECT_TRUE(found.time_corrected);
  }
}

TEST(Pipeline, ARepeatedFrameIsCountedAndGivesNoSecondSample) {
  Pipeline pipeline(imu_and_gps());
  Recorder recorder;
  for (int k = 0; k < 100; ++k) {
    pipeline.bytes(0, 10 * base::kSecond_ns + k * 50 * base::kMillisecond_ns, imu_frame(k), recorder);
    if (k == 60)
      pipeline.bytes(0, 10 * base::kSecond_ns + k * 50 * base::kMillisecond_ns + 4 * base::kMillisecond_ns,
                     imu_frame(k), recorder);
  }
  EXPECT_EQ(recorder.samples.size(), 100U);
  EXPECT_EQ(pipeline.statistics(0).repeated, 1U);
}

TEST(Pipeline, GarbageOnOnePortDoesNothingToAnother) {
  const auto reads = stream(8, 20);
  Recorder clean, dirty;
  Pipeline a(imu_and_gps()), b(imu_and_gps());
  std::mt19937 random(1);
  for (const auto& read : reads) {
    if (read.port != 0) continue;
    a.bytes(0, read.arrival_ns, read.bytes, clean);
    std::vector<std::uint8_t> noise(random() % 200);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    b.bytes(1, read.arrival_ns, noise, dirty);
    b.bytes(0, read.arrival_ns, read.bytes, dirty);
  }
  std::erase_if(dirty.samples, [](const auto& sample) { return sample.port != 0; });
  ASSERT_EQ(clean.samples.size(), dirty.samples.size());
  for (std::size_t i = 0; i < clean.samples.size(); ++i) {
    EXPECT_TRUE(same(clean.samples[i].stamp, dirty.samples[i].stamp));
  }
}

}  // namespace
}  // namespace navcal::pipeline
