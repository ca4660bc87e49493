// SPDX-License-Identifier: Apache-2.0
#include "daemon/disk_thread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/daemon/difficult_disk.h"
#include "tests/support/temporary_folder.h"

namespace navcal::daemon {
namespace {

using namespace std::chrono_literals;

class DiskThreadTest : public ::testing::Test {
 protected:
  void begin(std::uint64_t queue_bytes, std::uint64_t floor_bytes = 0) {
    DiskThread::Options options;
    options.sync_interval = 5ms;
    options.retry_interval = 5ms;
    options.queue_bytes = queue_bytes;
    options.free_floor_bytes = floor_bytes;
    thread_ = std::make_unique<DiskThread>([this] { return record::LogFolder(disk_, folder_.path()); }, options);
    thread_->next_file(0, [](std::string& out) { out += "begin\n"; });
  }

  bool append(const std::string& record) {
    return thread_->append([&](std::string& out) { out += record; });
  }

  /// The contents of all logs, in the order of their names.
  std::vector<std::string> logs() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      if (entry.path().extension() == ".mcap") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::vector<std::string> contents;
    for (const auto& file : files) {
      std::ifstream in(file, std::ios::binary);
      contents.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return contents;
  }

  template <class Condition>
  bool eventually(Condition&& condition) {
    for (int i = 0; i < 2000; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  }

  DifficultDisk disk_;
  test::TemporaryFolder folder_;
  std::unique_ptr<DiskThread> thread_;
};

TEST_F(DiskThreadTest, AStalledDiskLosesNothingWhileTheQueueHoldsAndHoldsUpNobody) {
  disk_.stalled = true;
  begin(32 << 20);
  std::string expected = "begin\n";
  for (int i = 0; i < 3000; ++i) {
    const std::string record = std::to_string(i) + "\n";
    // Were this to wait for the disk, it would wait for ever.
    ASSERT_TRUE(append(record));
    expected += record;
    if (i % 500 == 0) std::this_thread::sleep_for(10ms);
  }
  EXPECT_EQ(thread_->state().file_bytes, 0U);
  disk_.stalled = false;
  thread_->stop();
  EXPECT_EQ(thread_->state().dropped, 0U);
  EXPECT_EQ(logs(), std::vector<std::string>{expected});
}

TEST_F(DiskThreadTest, BeyondTheQueueWholeRecordsAreLostAndCounted) {
  disk_.stalled = true;
  begin(4000);
  std::string expected = "begin\n";
  std::uint64_t lost = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string record = "record " + std::to_string(i) + "\n";
    append(record) ? void(expected += record) : void(++lost);
  }
  EXPECT_GT(lost, 0U);
  EXPECT_EQ(thread_->state().dropped, lost);
  EXPECT_LE(thread_->state().queued_bytes, 4000U + 20U);
  disk_.stalled = false;
  ASSERT_TRUE(eventually([&] { return thread_->state().queued_bytes == 0; }));
  ASSERT_TRUE(append("afterwards\n"));
  thread_->stop();
  EXPECT_EQ(logs(), std::vector<std::string>{expected + "afterwards\n"});
}

TEST_F(DiskThreadTest, ARecordIsNeverTornAcrossFiles) {
  begin(1 << 20);
  std::vector<std::string> expected{"begin\n"};
  for (int i = 0; i < 1000; ++i) {
    const std::string record = std::to_string(i) + "\n";
    ASSERT_TRUE(append(record));
    expected.back() += record;
    if (i % 97 == 96) {
      thread_->end_file([](std::string& out) { out += "end\n"; });
      expected.back() += "end\n";
      thread_->next_file(0, [](std::string& out) { out += "begin\n"; });
      expected.emplace_back("begin\n");
    }
  }
  thread_->stop();
  EXPECT_EQ(logs(), expected);
}

TEST_F(DiskThreadTest, AClosedFileIsWholeAndTheNextBeginsOnlyWhenAsked) {
  begin(1 << 20);
  ASSERT_TRUE(append("one\n"));
  thread_->end_file([](std::string& out) { out += "end\n"; });
  thread_->close_file();
  ASSERT_TRUE(eventually([&] { return logs() == std::vector<std::string>{"begin\none\nend\n"}; }));
  ASSERT_TRUE(eventually([&] { return thread_->state().file.empty(); }));
  thread_->next_file(0, [](std::string& out) { out += "again\n"; });
  ASSERT_TRUE(append("two\n"));
  thread_->stop();
  EXPECT_EQ(logs(), (std::vector<std::string>{"begin\none\nend\n", "again\ntwo\n"}));
}

TEST_F(DiskThreadTest, AFileClosedWhileTheDiskIsFullIsWholeOnceThereIsRoom) {
  begin(1 << 20);
  disk_.full = true;
  ASSERT_TRUE(append("one\n"));
  ASSERT_TRUE(eventually([&] { return thread_->state().state == DiskState::State::full; }));
  thread_->end_file([](std::string& out) { out += "end\n"; });
  thread_->close_file();
  EXPECT_EQ(thread_->state().state, DiskState::State::full);
  disk_.full = false;
  ASSERT_TRUE(eventually([&] { return thread_->state().file.empty(); }));
  EXPECT_EQ(thread_->state().state, DiskState::State::writing);
  EXPECT_EQ(logs(), std::vector<std::string>{"begin\none\nend\n"});
}

TEST_F(DiskThreadTest, AFullDiskIsSaidWaitedForAndNothingQueuedIsLost) {
  begin(1 << 20);
  ASSERT_TRUE(append("before\n"));
  ASSERT_TRUE(eventually([&] { return thread_->state().queued_bytes == 0; }));
  disk_.full = true;
  ASSERT_TRUE(append("while full\n"));
  ASSERT_TRUE(eventually([&] { return thread_->state().state == DiskState::State::full; }));
  EXPECT_FALSE(thread_->state().reason.empty());
  EXPECT_FALSE(thread_->take_notices().empty());
  disk_.full = false;
  ASSERT_TRUE(eventually([&] { return thread_->state().state == DiskState::State::writing; }));
  thread_->stop();
  EXPECT_EQ(logs(), std::vector<std::string>{"begin\nbefore\nwhile full\n"});
}

TEST_F(DiskThreadTest, AFullDiskIsRelievedOfItsOldestFinishedLog) {
  begin(1 << 20, 1);
  ASSERT_TRUE(append("old\n"));
  thread_->next_file(0, [](std::string& out) { out += "begin\n"; });
  ASSERT_TRUE(eventually([&] { return logs().size() == 2 && thread_->state().queued_bytes == 0; }));
  disk_.free = 0;
  disk_.full = true;
  ASSERT_TRUE(append("new\n"));
  ASSERT_TRUE(eventually([&] { return thread_->state().queued_bytes == 0; }));
  thread_->stop();
  EXPECT_EQ(logs(), std::vector<std::string>{"begin\nnew\n"});
}

TEST_F(DiskThreadTest, AFloorThatCannotBeKeptRemovesNothingAndLogsOn) {
  begin(1 << 20);
  ASSERT_TRUE(append("old\n"));
  thread_->stop();
  disk_.free = 1 << 20;
  begin(1 << 20, 1 << 30);
  ASSERT_TRUE(append("new\n"));
  ASSERT_TRUE(eventually([&] { return thread_->state().queued_bytes == 0; }));
  EXPECT_EQ(thread_->state().state, DiskState::State::writing);
  thread_->stop();
  EXPECT_EQ(logs(), (std::vector<std::string>{"begin\nold\n", "begin\nnew\n"}));
  const auto notices = thread_->take_notices();
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_NE(notices[0].find("log.free_floor_MB"), std::string::npos) << notices[0];
}

TEST_F(DiskThreadTest, AFileThatSomebodyRemovesIsToldAndTheNextIsWhole) {
  begin(1 << 20);
  ASSERT_TRUE(append("old\n"));
  ASSERT_TRUE(eventually([&] { return thread_->state().queued_bytes == 0 && !thread_->state().file.empty(); }));
  EXPECT_FALSE(thread_->state().is_gone);
  std::filesystem::remove(thread_->state().file);
  EXPECT_TRUE(eventually([&] { return thread_->state().is_gone; }));
  thread_->next_file(0, [](std::string& out) { out += "again\n"; });
  EXPECT_TRUE(eventually([&] { return !thread_->state().is_gone; }));
  thread_->stop();
  EXPECT_EQ(logs(), std::vector<std::string>{"again\n"});
}

TEST_F(DiskThreadTest, WithoutAFolderItWaitsAndSaysWhy) {
  DiskThread::Options options;
  options.retry_interval = 5ms;
  std::atomic<bool> is_there{false};
  thread_ = std::make_unique<DiskThread>(
      [&] {
        if (!is_there)
          throw std::system_error(std::make_error_code(std::errc::read_only_file_system), "the folder");
        return record::LogFolder(disk_, folder_.path());
      },
      options);
  thread_->next_file(0, [](std::string& out) { out += "begin\n"; });
  ASSERT_TRUE(eventually([&] { return thread_->state().state == DiskState::State::failing; }));
  EXPECT_NE(thread_->state().reason.find("the folder"), std::string::npos);
  ASSERT_TRUE(append("one\n"));
  is_there = true;
  ASSERT_TRUE(eventually([&] { return thread_->state().state == DiskState::State::writing; }));
  thread_->stop();
  EXPECT_EQ(logs(), std::vector<std::string>{"begin\none\n"});
}

TEST_F(DiskThreadTest, ASyncThatFailsIsSaidAndWhatItDroppedIsWrittenAnew) {
  begin(1 << 20);
  ASSERT_TRUE(append("before\n"));
  ASSERT_TRUE(eventually([&] { return thread_->state().synced_bytes == 13; }));
  disk_.no_sync = true;
  ASSERT_TRUE(append("dropped by the kernel\n"));
  ASSERT_TRUE(eventually([&] { return thread_->state().state == DiskState::State::failing; }));
  EXPECT_NE(thread_->state().reason.find("cannot be synced"), std::string::npos);
  EXPECT_EQ(thread_->state().synced_bytes, 13U);
  ASSERT_TRUE(append("queued meanwhile\n"));
  disk_.no_sync = false;
  ASSERT_TRUE(eventually([&] { return thread_->state().state == DiskState::State::writing; }));
  thread_->stop();
  EXPECT_EQ(logs(), std::vector<std::string>{"begin\nbefore\ndropped by the kernel\nqueued meanwhile\n"});
}

TEST_F(DiskThreadTest, StoppingWhileEverySyncFailsEnds) {
  begin(1 << 20);
  disk_.no_sync = true;
  ASSERT_TRUE(append("never synced\n"));
  thread_->stop();
  EXPECT_EQ(thread_->state().state, DiskState::State::failing);
}

TEST_F(DiskThreadTest, StoppingWithAFullDiskEnds) {
  begin(1 << 20);
  disk_.full = true;
  ASSERT_TRUE(append("never written\n"));
  thread_->stop();
  EXPECT_EQ(thread_->state().state, DiskState::State::full);
  const auto notices = thread_->take_notices();
  ASSERT_FALSE(notices.empty());
  EXPECT_NE(notices.back().find("never written"), std::string::npos);
}

TEST_F(DiskThreadTest, WhatWasAppendedIsSyncedWithinItsInterval) {
  begin(1 << 20);
  ASSERT_TRUE(append("soon on the disk\n"));
  EXPECT_TRUE(eventually([&] { return thread_->state().synced_bytes == 23; }));
  thread_->stop();
}

}  // namespace
}  // namespace navcal::daemon
