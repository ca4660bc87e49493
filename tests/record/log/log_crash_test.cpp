// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "record/log/log_folder.h"
#include "record/log/log_reader.h"
#include "tests/record/memory_disk.h"
#include "tests/record/memory_source.h"
#include "tests/record/sample_log.h"

namespace navcal::record {
namespace {

constexpr std::int64_t kNow_ns = 1'795'000'000'000'000'000;

/// Writes a log as the disk thread does, one read at a time; answers how many bytes were synced when the power
/// went.
std::uint64_t write_until_power_fails(Disk& disk, const testing::SampleLog& log) {
  LogFolder folder(disk, "/logs");
  folder.finish_unfinished();
  std::error_code error;
  const auto file = folder.create(kNow_ns, error);
  if (!file) return 0;
  std::size_t from = 0;
  for (std::size_t i = 0; i < log.ends.size(); i += 7) {
    if (file->append(std::string_view(log.bytes).substr(from, log.ends[i] - from))) return file->synced_bytes();
    from = log.ends[i];
    if (i % 3 == 0 && file->sync()) return file->synced_bytes();
  }
  if (file->append(std::string_view(log.bytes).substr(from)) || file->finish()) return file->synced_bytes();
  return log.bytes.size();
}

std::uint64_t synced_before(const testing::SampleLog& log, std::uint64_t bytes) {
  std::uint64_t whole = 0;
  for (const auto end : log.ends) whole += end <= bytes ? 1U : 0U;
  return whole;
}

TEST(LogCrash, PowerLostBetweenAnyTwoOperationsCostsNothingThatWasSynced) {
  const auto log = testing::sample_log(2, true);
  std::mt19937 random(3);
  for (std::uint64_t operations = 0; operations < 80; ++operations) {
    testing::MemoryDisk disk;
    disk.operations_left = operations;
    const std::uint64_t synced = write_until_power_fails(disk, log);
    disk.power_cycle(random);

    LogFolder folder(disk, "/logs");
    for (const auto& repair : folder.finish_unfinished()) ASSERT_FALSE(repair.error) << repair.message();
    const auto names = disk.names();
    if (synced > 0) {
      ASSERT_EQ(names.size(), 1U) << operations;
    }
    for (const auto& name : names) {
      LogReader reader(std::make_unique<MemorySource>(disk.content(name)), name);
      std::uint64_t messages = 0;
      while (reader.next()) ++messages;
      ASSERT_TRUE(reader.findings().finished) << operations << " " << reader.remarks().front();
      ASSERT_GE(messages, synced_before(log, synced)) << operations;
      ASSERT_EQ(reader.findings().bad_crc, 0U);
    }
  }
}

TEST(LogCrash, PowerLostDuringTheRepairIsRepairedInTurn) {
  const auto log = testing::sample_log(1, false);
  std::string damaged = log.bytes;
  damaged[log.ends[5] + 2] = '\x7F';
  damaged += "half a rec";
  std::mt19937 random(4);
  for (std::uint64_t operations = 0; operations < 8; ++operations) {
    testing::MemoryDisk disk;
    {
      std::error_code error;
      const auto file = LogFile::create(disk, "/logs/" + log_name(kNow_ns, 1), error);
      ASSERT_FALSE(file->append(damaged) || file->sync());
    }
    disk.operations_left = operations;
    const Repair interrupted = finish_log(disk, "/logs/" + log_name(kNow_ns, 1));
    EXPECT_TRUE(interrupted.error || operations > 5) << operations;
    disk.power_cycle(random);
    const Repair repair = finish_log(disk, "/logs/" + log_name(kNow_ns, 1));
    ASSERT_FALSE(repair.error) << repair.message();
    EXPECT_EQ(repair.messages, log.messages - 1);
    LogReader reader(std::make_unique<MemorySource>(disk.content(log_name(kNow_ns, 1))), "x");
    while (reader.next()) {
    }
    EXPECT_TRUE(reader.findings().finished);
  }
}

TEST(LogCrash, AFullDiskLeavesTheFileAsItWas) {
  const auto log = testing::sample_log(1, false);
  testing::MemoryDisk disk;
  disk.capacity = 4000;
  std::error_code error;
  const auto file = LogFile::create(disk, "/logs/" + log_name(kNow_ns, 1), error);
  const auto head = std::string_view(log.bytes).substr(0, 3000);
  ASSERT_FALSE(file->append(head));
  EXPECT_EQ(file->append(std::string_view(log.bytes).substr(3000)), std::errc::no_space_on_device);
  EXPECT_EQ(file->bytes(), 3000U);
  disk.capacity = UINT64_MAX;
  ASSERT_FALSE(file->append(std::string_view(log.bytes).substr(3000)));
  ASSERT_FALSE(file->finish());
  EXPECT_EQ(disk.content(log_name(kNow_ns, 1)), log.bytes);
}

}  // namespace
}  // namespace navcal::record
