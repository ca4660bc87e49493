// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "tests/record/memory_disk.h"
#include "tests/record/sample_log.h"
#include "tests/support/temporary_folder.h"

namespace navcal::record {
namespace {

constexpr std::int64_t kFolderTime_ns = 1'795'000'000'000'000'000;

class LogFolderOnDisk : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path();
};

std::string write_log(LogFolder& folder, std::int64_t utc_ns, std::string_view bytes, bool finish) {
  std::error_code error;
  const auto file = folder.create(utc_ns, error);
  EXPECT_TRUE(file) << error.message();
  EXPECT_FALSE(file->append(bytes));
  EXPECT_FALSE(file->sync());
  if (finish) {
    EXPECT_FALSE(file->finish());
  }
  return file->path().filename();
}

TEST(LogName, TellsTimeAndCounter) {
  EXPECT_EQ(log_name(1'795'228'200'000'000'000, 123), "navcal-20261121T023000Z-000123.mcap");
  EXPECT_EQ(log_name(-5, 12345678), "navcal-19700101T000000Z-12345678.mcap");
}

TEST_F(LogFolderOnDisk, AClockThatStepsBackRepeatsNoNameAndNoOrder) {
  std::string last;
  for (int i = 0; i < 5; ++i) {
    LogFolder folder(real_disk(), path_);
    const auto name = write_log(folder, kFolderTime_ns - i * 86'400'000'000'000LL, "x", true);
    const std::string counter = name.substr(name.size() - 11, 6);
    EXPECT_EQ(counter, "00000" + std::to_string(i + 1));
  }
  LogFolder folder(real_disk(), path_);
  std::ofstream(path_ / log_name(kFolderTime_ns, 41)) << "copied here";
  EXPECT_EQ(write_log(folder, kFolderTime_ns, "x", true), log_name(kFolderTime_ns, 42));
}

TEST_F(LogFolderOnDisk, AFinishedFileHasItsLengthAndIsReadOnly) {
  LogFolder folder(real_disk(), path_);
  const auto log = testing::sample_log(1, true);
  const auto name = write_log(folder, kFolderTime_ns, log.bytes, true);
  struct stat status {};
  ASSERT_EQ(::stat((path_ / name).c_str(), &status), 0);
  EXPECT_EQ(static_cast<std::size_t>(status.st_size), log.bytes.size());
  EXPECT_EQ(status.st_mode & 0777U, 0444U);
  // The space taken in advance was given back.
  EXPECT_LT(status.st_blocks * 512, 1 << 20);
  EXPECT_TRUE(folder.finish_unfinished().empty());
}

TEST_F(LogFolderOnDisk, WhatALossOfPowerLeftOpenIsFinished) {
  const auto log = testing::sample_log(1, false);
  std::string name;
  {
    LogFolder folder(real_disk(), path_);
    name = write_log(folder, kFolderTime_ns, log.bytes + "torn", false);
    // While it is being written nobody else may finish it.
    std::error_code error;
    const auto file = folder.create(kFolderTime_ns, error);
    EXPECT_EQ(finish_log(real_disk(), file->path()).error, std::errc::resource_unavailable_try_again);
  }
  LogFolder folder(real_disk(), path_);
  const auto repairs = folder.finish_unfinished();
  ASSERT_EQ(repairs.size(), 2U);
  EXPECT_EQ(repairs[0].file, name);
  EXPECT_FALSE(repairs[0].error);
  EXPECT_EQ(repairs[0].messages, log.messages);
  EXPECT_EQ(repairs[1].messages, 0U);
  EXPECT_FALSE(repairs[1].error) << repairs[1].message();
  EXPECT_TRUE(folder.finish_unfinished().empty());
}

TEST_F(LogFolderOnDisk, ASecondProcessIsRefused) {
  const LogFolder folder(real_disk(), path_);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    try {
      const LogFolder second(real_disk(), path_);
      ::_exit(1);
    } catch (const std::system_error& error) {
      const bool clear =
          std::string(error.what()).find("another navcald is writing logs there") != std::string::npos;
      ::_exit(clear ? 42 : 2);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 42);
}

TEST_F(LogFolderOnDisk, AFolderThatCannotBeWrittenIsNamedWithTheReason) {
  ::chmod(path_.c_str(), 0555);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    // Root may write anywhere; nobody may not.
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(3);
    try {
      const LogFolder second(real_disk(), path_);
      ::_exit(1);
    } catch (const std::system_error& error) {
      const bool clear = std::string(error.what()).find("this user may not write there") != std::string::npos;
      ::_exit(clear && error.code() == std::errc::permission_denied ? 42 : 2);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 42);
}

TEST(LogFolder, AFolderThatIsNotThereIsNamed) {
  try {
    const LogFolder folder(real_disk(), "/nonexistent/logs");
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
    EXPECT_NE(std::string(error.what()).find("log folder /nonexistent/logs: it does not exist"),
              std::string::npos);
  }
}

TEST(LogFolder, RoomIsMadeByTheOldestFinishedLogs) {
  testing::MemoryDisk disk;
  disk.capacity = 100'000;
  LogFolder folder(disk, "/logs");
  const std::string bytes(20'000, 'x');
  std::error_code error;
  const auto unfinished = folder.create(kFolderTime_ns, error);
  ASSERT_FALSE(unfinished->append(bytes));
  const auto first = write_log(folder, kFolderTime_ns - 5, bytes, true);
  const auto second = write_log(folder, kFolderTime_ns - 9, bytes, true);
  const auto current = folder.create(kFolderTime_ns, error);
  ASSERT_FALSE(current->append(bytes));

  EXPECT_TRUE(folder.keep_free(10'000).removed.empty());
  EXPECT_EQ(folder.keep_free(30'000).removed, std::vector<std::string>{first});
  EXPECT_TRUE(folder.keep_free(90'000).removed.empty()) << "the one that is left would not be enough";
  EXPECT_EQ(folder.remove_oldest().removed, std::vector<std::string>{second});
  EXPECT_TRUE(folder.remove_oldest().removed.empty());
  EXPECT_EQ(disk.names().size(), 2U);
}

TEST(LogFolder, TheMissionBeforeIsNeverRemoved) {
  testing::MemoryDisk disk;
  disk.capacity = 100'000;
  const std::string bytes(20'000, 'x');
  std::string oldest;
  {
    LogFolder before(disk, "/logs");
    oldest = write_log(before, kFolderTime_ns, bytes, true);
    write_log(before, kFolderTime_ns, bytes, true);
  }
  LogFolder folder(disk, "/logs");
  const auto own = write_log(folder, kFolderTime_ns, bytes, true);
  EXPECT_EQ(folder.remove_oldest().removed, std::vector<std::string>{oldest});
  EXPECT_EQ(folder.remove_oldest().removed, std::vector<std::string>{own});
  EXPECT_TRUE(folder.remove_oldest().removed.empty());
  EXPECT_EQ(disk.names().size(), 1U);
}

TEST_F(LogFolderOnDisk, AFileThatSomebodyRemovedIsGone) {
  std::error_code error;
  const auto file = real_disk().create(path_ / "a", error);
  ASSERT_TRUE(file) << error.message();
  EXPECT_FALSE(file->is_gone());
  ASSERT_FALSE(real_disk().remove(path_ / "a"));
  EXPECT_TRUE(file->is_gone());
}

}  // namespace
}  // namespace navcal::record
