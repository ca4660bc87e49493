// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_repair.h"

#include <gtest/gtest.h>

#include "record/log/log_folder.h"
#include "record/log/log_reader.h"
#include "tests/record/memory_disk.h"
#include "tests/record/memory_source.h"
#include "tests/record/sample_log.h"

namespace navcal::record {
namespace {

/// A log that its writer left open, and what its repair made of it.
struct RepairedLog {
  explicit RepairedLog(std::string_view left) {
    std::error_code error;
    const std::string path = std::string("/logs/") + kName;
    {
      const auto file = LogFile::create(disk, path, error);
      EXPECT_FALSE(file->append(left) || file->sync());
    }
    repair = finish_log(disk, path);
    EXPECT_FALSE(repair.error) << repair.message();
  }
  static constexpr const char* kName = "navcal-20261121T023000Z-000001.mcap";
  testing::MemoryDisk disk;
  Repair repair;
};

TEST(LogRepair, AnIntactLogGetsTheEndThatItsWriterWouldHaveWritten) {
  const auto open = testing::sample_log(2, false), closed = testing::sample_log(2, true);
  const RepairedLog log(open.bytes);
  EXPECT_EQ(log.disk.content(RepairedLog::kName), closed.bytes);
  EXPECT_EQ(log.repair.message(), std::string(RepairedLog::kName) + ": finished, " +
                                      std::to_string(open.messages) +
                                      " messages kept, 0 bytes after the last whole record removed");
}

TEST(LogRepair, WhatIsDamagedIsCountedAndStaysReadable) {
  const auto open = testing::sample_log(2, false);
  std::string bytes = open.bytes;
  bytes[open.ends[9] - 3] = static_cast<char>(bytes[open.ends[9] - 3] ^ 1);
  bytes.insert(open.ends[20], std::string(700, 'g'));
  const RepairedLog log(bytes + "half a rec");
  EXPECT_EQ(log.repair.messages, open.messages - 1);
  EXPECT_EQ(log.repair.bad_crc, 1U);
  EXPECT_EQ(log.repair.masked_bytes, 700U);
  EXPECT_EQ(log.repair.cut_bytes, 10U);
  EXPECT_EQ(log.repair.message(),
            std::string(RepairedLog::kName) + ": finished, " + std::to_string(open.messages - 1) +
                " messages kept, 10 bytes after the last whole record removed, 1 messages whose checksum does not "
                "hold, 700 damaged bytes masked");
  LogReader reader(std::make_unique<MemorySource>(log.disk.content(RepairedLog::kName)), "x");
  std::uint64_t messages = 0;
  while (reader.next()) ++messages;
  EXPECT_EQ(messages, open.messages - 1);
  EXPECT_TRUE(reader.findings().finished);
}

}  // namespace
}  // namespace navcal::record
