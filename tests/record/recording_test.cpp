// SPDX-License-Identifier: Apache-2.0
#include "record/recording.h"

#include <gtest/gtest.h>

#include <sstream>

#include "config/load.h"
#include "record/capture/capture_recording.h"
#include "record/export/export.h"
#include "record/log/log_info.h"
#include "record/log/log_recording.h"
#include "tests/record/sample_log.h"
#include "tests/record/temporary_folder.h"

namespace navcal::record {
namespace {

using RecordingFiles = testing::TemporaryFolder;

std::vector<Entry> entries_of(Recording& recording) {
  std::vector<Entry> entries;
  while (auto entry = recording.next()) entries.push_back(std::move(*entry));
  return entries;
}

TEST_F(RecordingFiles, ALogGivesBackBytesMappingsAndEvents) {
  const auto log = testing::sample_log(2, true);
  const auto recording = Recording::open(write("a.mcap", log.bytes));
  EXPECT_EQ(recording->settings(), testing::sample_settings());
  const auto entries = entries_of(*recording);
  std::uint64_t raw = 0;
  std::uint64_t events = 0;
  for (const auto& entry : entries) {
    if (const auto* read = std::get_if<RawRead>(&entry)) {
      EXPECT_EQ(read->bytes.size(), read->port == 1 ? 22U : 51U);
      EXPECT_GE(read->time_ns, testing::kSampleStart_ns);
      ++raw;
    }
    events += std::holds_alternative<LoggedEvent>(entry) ? 1U : 0U;
  }
  EXPECT_EQ(raw, log.raw_messages);
  EXPECT_EQ(events, 2U);
  const auto* const first = std::get_if<MappingChange>(&entries.front());
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->mapping.offset_ns, testing::kSampleOffset_ns);
  EXPECT_EQ(first->mapping.bound_ns, 20'000'000);
  EXPECT_TRUE(recording->remarks().empty());
  EXPECT_DOUBLE_EQ(recording->progress(), 1.0);
}

TEST_F(RecordingFiles, ALogWhoseConfigurationIsDamagedKeepsItsPorts) {
  auto log = testing::sample_log(1, true);
  log.bytes[log.bytes.find("\"toml\"", log.bytes.find("CONFIG")) + 1] = 'T';
  const auto recording = Recording::open(write("a.mcap", log.bytes));
  ASSERT_EQ(recording->settings().ports.size(), 2U);
  EXPECT_EQ(recording->settings().ports[1].name, "imu");
  EXPECT_EQ(recording->settings().ports[1].baud, 57600);
  std::uint64_t raw = 0;
  for (const auto& entry : entries_of(*recording)) raw += std::holds_alternative<RawRead>(entry) ? 1U : 0U;
  EXPECT_EQ(raw, log.raw_messages);
  EXPECT_FALSE(recording->remarks().empty());
}

TEST_F(RecordingFiles, ACaptureIsInUtcFromItsFirstEntryOn) {
  const auto recording =
      Recording::open(write("a.cap", "#capture 1\n#port imu imu-card 57600\n1700000000.125003881 imu < a55a\n"));
  const auto entries = entries_of(*recording);
  ASSERT_EQ(entries.size(), 2U);
  const auto& mapping = std::get<MappingChange>(entries[0]).mapping;
  EXPECT_EQ(mapping.source, pipeline::UtcMapping::Source::file);
  EXPECT_EQ(mapping.offset_ns, 0);
  EXPECT_EQ(mapping.bound_ns, 0);
  EXPECT_EQ(std::get<RawRead>(entries[1]).time_ns, 1'700'000'000'125'003'881);
}

TEST_F(RecordingFiles, WhatIsNeitherIsRefusedByName) {
  const auto file = write("a.txt", "hello");
  try {
    Recording::open(file);
    FAIL();
  } catch (const BadRecording& error) {
    EXPECT_TRUE(
        std::string(error.what())
            .starts_with(file.string() +
                         ": neither a capture (\"#capture 1\") nor a log (MCAP); \"navcal log import\" reads "
                         "those of other systems that it knows by their content, and with --driver NAME "
                         "(navcal log import --help) a device's bytes"))
        << error.what();
  }
  EXPECT_THROW(Recording::open(path_ / "absent"), BadRecording);
  EXPECT_THROW(Recording::open(path_), BadRecording);
}

TEST_F(RecordingFiles, RecordingsOfRealInstrumentsAreRead) {
  const std::filesystem::path data = std::filesystem::path(NAVCAL_SHARED_DIR) / "data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  for (const auto* name : {"broad34.cap", "hmc_sphere.cap", "sg171.cap"}) {
    const auto recording = Recording::open(data / name);
    EXPECT_GT(entries_of(*recording).size(), 1000U) << name;
    EXPECT_TRUE(recording->remarks().empty()) << name;
  }
}

TEST_F(RecordingFiles, NamesOfPortsInADamagedLogFollowTheRuleOfCaptures) {
  auto settings = testing::sample_settings();
  settings.ports[0].name = "../x";
  settings.ports[1].name = "a\x1b[2J";
  std::string log;
  LogEncoder encoder(settings, "not TOML");
  encoder.begin(log, testing::kSampleStart_ns, {});
  encoder.raw(log, 0, Direction::received, testing::kSampleStart_ns, std::vector<std::uint8_t>{1});
  encoder.finish(log, testing::kSampleStart_ns);
  EXPECT_TRUE(Recording::open(write("a.mcap", log))->settings().ports.empty());
}

/// A clock that begins in 1970, and a receiver that knows UTC later.
std::string log_of_late_utc(bool has_system_clock) {
  const auto settings = testing::sample_settings();
  const auto sample = [](std::int64_t at_ns, std::int64_t offset_ns) {
    auto imu = testing::imu_sample(at_ns);
    imu.stamp.arrival_utc_ns = at_ns + offset_ns;
    imu.stamp.validity_utc_ns = imu.stamp.validity_ns + offset_ns;
    return imu;
  };
  std::string log;
  LogEncoder encoder(settings, config::to_toml(settings));
  const std::int64_t begin_ns = testing::kSampleStart_ns, before_ns = has_system_clock ? 40 * 1'000'000'000LL : 0;
  const auto source = has_system_clock ? pipeline::UtcMapping::Source::system : pipeline::UtcMapping::Source::none;
  encoder.begin(log, begin_ns, {source, before_ns, pipeline::UtcMapping::kUnknownBound, begin_ns});
  for (int i = 0; i < 20; ++i) {
    const std::int64_t at_ns = begin_ns + i * 100'000'000LL;
    if (i == 10)
      encoder.mapping(log, at_ns,
                      {pipeline::UtcMapping::Source::gps, testing::kSampleOffset_ns, 60'000'000, at_ns});
    encoder.raw(log, 1, Direction::received, at_ns, std::vector<std::uint8_t>(22));
    encoder.sample(log, sample(at_ns, i < 10 ? before_ns : testing::kSampleOffset_ns));
    encoder.event(log, at_ns, "info", "mark", "", "n");
  }
  encoder.finish(log, begin_ns);
  return log;
}

TEST_F(RecordingFiles, ALogIsOnOneScaleOfUtcAlsoBeforeItWasKnown) {
  for (const bool has_system_clock : {false, true}) {
    const auto file = write("a.mcap", log_of_late_utc(has_system_clock));
    const auto recording = Recording::open(file);
    for (const Entry& entry : entries_of(*recording)) {
      const auto* const change = std::get_if<MappingChange>(&entry);
      EXPECT_TRUE(change == nullptr || change->mapping.offset_ns == testing::kSampleOffset_ns);
    }
    const auto info = read_info(file, [](double) {});
    EXPECT_EQ(info.start_utc_ns, testing::kSampleStart_ns + testing::kSampleOffset_ns);
    EXPECT_EQ(info.end_utc_ns - info.start_utc_ns, 1'900'000'000);
    const auto exported = export_csv(file, path_ / "csv", [](double) {});
    for (const char* table : {"imu.csv", "event.csv", "raw_imu.csv"}) {
      std::istringstream rows(read(path_ / "csv" / table));
      std::string row;
      std::getline(rows, row);
      double last_s = 0;
      for (int i = 0; std::getline(rows, row); ++i) {
        const double time_s = std::stod(row);
        EXPECT_NEAR(time_s, 1'790'000'005 + 0.1 * i, 0.06) << table << " " << row;
        EXPECT_GT(time_s, last_s);
        last_s = time_s;
      }
      EXPECT_GT(last_s, 0) << table;
    }
    EXPECT_NE(read(path_ / "csv" / "imu.csv").find("\n1790000004.950000001,0.001500000,1790000005.000000001,"),
              std::string::npos);
  }
}

/// Reads one second apart from 2026-01-01T00:00:10Z on, in UTC by a log's mapping: the first `reads` of imu.
std::string log_of_seconds(int reads) {
  const auto settings = testing::sample_settings();
  std::string log;
  LogEncoder encoder(settings, config::to_toml(settings));
  constexpr std::int64_t kSecond_ns = 1'000'000'000, kNewYear_ns = 1'767'225'600 * kSecond_ns;
  const std::int64_t begin_ns = testing::kSampleStart_ns;
  encoder.begin(log, begin_ns,
                {pipeline::UtcMapping::Source::gps, kNewYear_ns + 10 * kSecond_ns - begin_ns, 1, begin_ns});
  for (int i = 0; i < reads; ++i) {
    const std::int64_t at_ns = begin_ns + i * kSecond_ns;
    encoder.raw(log, 1, Direction::received, at_ns, std::vector<std::uint8_t>{static_cast<std::uint8_t>(i)});
    encoder.event(log, at_ns + 1, "info", "mark", "", std::to_string(i));
  }
  encoder.finish(log, begin_ns);
  return log;
}

TEST_F(RecordingFiles, AWindowHoldsTheReadsFromItsBeginUpToItsEnd) {
  const auto file = write("a.mcap", log_of_seconds(10));
  const auto reads_within = [&](const char* from, const char* to) {
    TimeWindow window;
    if (from != nullptr) window.from = parse_time_bound(from).value();
    if (to != nullptr) window.to = parse_time_bound(to).value();
    std::vector<int> numbers;
    for (const Entry& entry : entries_of(*Recording::open(file, window))) {
      if (const auto* read = std::get_if<RawRead>(&entry)) numbers.push_back(read->bytes.at(0));
    }
    return numbers;
  };
  using Numbers = std::vector<int>;
  EXPECT_EQ(reads_within("3", "6"), (Numbers{3, 4, 5})) << "seconds are those since the first read";
  EXPECT_EQ(reads_within("2026-01-01T00:00:13Z", "2026-01-01T00:00:16Z"), (Numbers{3, 4, 5}));
  EXPECT_EQ(reads_within("2.5", "2026-01-01T00:00:15.5Z"), (Numbers{3, 4, 5}));
  EXPECT_EQ(reads_within("8", nullptr), (Numbers{8, 9}));
  EXPECT_EQ(reads_within(nullptr, "2026-01-01T00:00:12Z"), (Numbers{0, 1}));
  EXPECT_EQ(reads_within("0", "100"), (Numbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_THROW(reads_within("2027-01-01T00:00:00Z", nullptr), NothingInWindow);
  EXPECT_THROW(reads_within(nullptr, "2025-01-01T00:00:00Z"), NothingInWindow);
}

TEST_F(RecordingFiles, WhatWasRecordedBeforeAWindowComesAtItsBegin) {
  const auto file = write("a.mcap", log_of_seconds(10));
  const auto entries = entries_of(*Recording::open(file, {parse_time_bound("3"), parse_time_bound("5")}));
  const std::int64_t begin_ns = testing::kSampleStart_ns + 3'000'000'000;
  ASSERT_FALSE(entries.empty());
  ASSERT_TRUE(std::holds_alternative<MappingChange>(entries.front())) << "without it there is no UTC";
  std::size_t events = 0;
  for (const Entry& entry : entries) {
    std::visit([&](const auto& one) { EXPECT_GE(one.time_ns, begin_ns); }, entry);
    events += std::holds_alternative<LoggedEvent>(entry) ? 1U : 0U;
  }
  EXPECT_EQ(events, 5U) << "of the reads 0 to 4";
}

TEST_F(RecordingFiles, ABoundIsSecondsOrUtc) {
  EXPECT_EQ(parse_time_bound("12.5").value().since_start_s, 12.5);
  EXPECT_FALSE(parse_time_bound("12.5").value().utc_ns);
  EXPECT_EQ(parse_time_bound("2026-01-01T00:00:12Z").value().utc_ns, 1'767'225'612'000'000'000);
  for (const char* const bad : {"", "-1", "noon", "12s"}) EXPECT_FALSE(parse_time_bound(bad)) << bad;
}

TEST_F(RecordingFiles, WhatALogLeavesOutIsRemarkedOnceUntilItChanges) {
  const auto settings = testing::sample_settings();
  std::string log;
  LogEncoder encoder(settings, config::to_toml(settings));
  encoder.begin(log, testing::kSampleStart_ns, {});
  for (const char* const parts : {"raw of imu", "raw of imu", "nothing", "nothing", "raw of imu"})
    encoder.event(log, testing::kSampleStart_ns, "info", "log.left_out", "", parts);
  encoder.finish(log, testing::kSampleStart_ns);
  const auto recording = Recording::open(write("a.mcap", log));
  EXPECT_EQ(entries_of(*recording).size(), 6U);
  ASSERT_EQ(recording->remarks().size(), 2U);
  EXPECT_NE(recording->remarks()[0].find("left out of this log by log.leave_out or log.select: raw of imu"),
            std::string::npos);
  EXPECT_EQ(recording->remarks()[0], recording->remarks()[1]);
}

}  // namespace
}  // namespace navcal::record
