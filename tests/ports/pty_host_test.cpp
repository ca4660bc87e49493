// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "tests/ports/harness.h"

namespace navcal::ports::testing {
namespace {

namespace fs = std::filesystem;

struct PtyHostTest : ::testing::Test {
  Folder folder;
  boost::asio::io_context io{1};
  std::string heard;
  fs::path link = folder.path() / "made" / "for" / "it" / "gps";
  PtyHost host{io.get_executor(), link, 9600,
               [this](std::int64_t, protocols::Bytes bytes) { heard.append(bytes.begin(), bytes.end()); }};

  std::string read_some(const base::Descriptor& client) {
    std::array<char, 8192> buffer{};
    std::string text;
    run_until(io, [&] {
      const ssize_t n = ::read(client.get(), buffer.data(), buffer.size());
      if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
      return n > 0;
    });
    return text;
  }
};

TEST_F(PtyHostTest, ItsFolderAndLinkAreMadeAndTheLinkIsRemoved) {
  EXPECT_EQ(fs::read_symlink(link), host.device());
  host.unplug();
  EXPECT_FALSE(fs::exists(fs::symlink_status(link)));
  EXPECT_TRUE(host.device().empty());
}

TEST_F(PtyHostTest, ALinkLeftBehindIsReplacedAndAFileIsNot) {
  const fs::path left = folder.path() / "left";
  fs::create_symlink("/nowhere", left);
  const PtyHost over_link(io.get_executor(), left, 9600, {});
  EXPECT_EQ(fs::read_symlink(left), over_link.device());
  const fs::path file = folder.path() / "file";
  std::ofstream(file) << "precious";
  EXPECT_THROW(PtyHost(io.get_executor(), file, 9600, {}), std::runtime_error);
  EXPECT_TRUE(fs::is_regular_file(file));
}

TEST_F(PtyHostTest, ALinkThatAnotherHasTakenIsNotRemoved) {
  point_link(link, "/dev/pts/others");
  host.unplug();
  EXPECT_EQ(fs::read_symlink(link), "/dev/pts/others");
}

TEST_F(PtyHostTest, ALinkThatAnotherHasIsRefusedUntilThatEnds) {
  const fs::path again = folder.path() / "." / link.lexically_relative(folder.path());
  EXPECT_THROW(PtyHost(io.get_executor(), again, 9600, {}), std::runtime_error);
  EXPECT_EQ(fs::read_symlink(link), host.device());
  const fs::path other = folder.path() / "other";
  { const PtyHost first(io.get_executor(), other, 9600, {}); }
  const PtyHost second(io.get_executor(), other, 9600, {});
  EXPECT_EQ(fs::read_symlink(other), second.device());
}

TEST_F(PtyHostTest, WhatNobodyHearsIsLostAndCounted) {
  EXPECT_FALSE(host.has_client());
  EXPECT_EQ(host.write(bytes_of("into the void")), 0U);
  const base::Descriptor client = open_client(link);
  EXPECT_TRUE(host.has_client());
  EXPECT_EQ(host.write(bytes_of("hello")), 5U);
  EXPECT_EQ(read_some(client), "hello");
  EXPECT_EQ(host.tally().unheard, 13U);
  EXPECT_EQ(host.tally().taken, 5U);
  EXPECT_EQ(host.tally().overrun, 0U);
}

TEST_F(PtyHostTest, AClientThatDoesNotReadOverrunsAndNeverBlocks) {
  const base::Descriptor client = open_client(link);
  const std::string block(1000, 'b');
  for (int i = 0; i < 1000; ++i) host.write(bytes_of(block));
  EXPECT_GT(host.tally().overrun, 900'000U);
  EXPECT_EQ(host.tally().taken + host.tally().overrun, 1'000'000U);
}

TEST_F(PtyHostTest, TheNextClientDoesNotFindTheLastOnesLeavings) {
  {
    const base::Descriptor client = open_client(link);
    run_for(io, std::chrono::milliseconds(50));
    host.write(bytes_of("unread"));
  }
  run_for(io, std::chrono::milliseconds(100));
  const base::Descriptor client = open_client(link);
  host.write(bytes_of("fresh"));
  EXPECT_EQ(read_some(client), "fresh");
}

TEST_F(PtyHostTest, ClientsComeAndGoAndAreHeard) {
  std::string said;
  for (int i = 0; i < 5; ++i) {
    const base::Descriptor client = open_client(link);
    const std::string line = "client " + std::to_string(i);
    ASSERT_EQ(::write(client.get(), line.data(), line.size()), static_cast<ssize_t>(line.size()));
    said += line;
    if (i % 2 == 0) {
      ASSERT_TRUE(run_until(io, [&] { return heard == said; }));
    }
  }
  EXPECT_TRUE(run_until(io, [&] { return heard == said; })) << heard;
}

TEST_F(PtyHostTest, UnreadBytesAreSeenUntilTheyAreRead) {
  const base::Descriptor client = open_client(link);
  host.write(bytes_of("12345"));
  ASSERT_TRUE(run_until(io, [&] { return host.unread() == 5; }));
  read_some(client);
  EXPECT_EQ(host.unread(), 0U);
}

TEST_F(PtyHostTest, UnpluggingHangsUpAndReplugingBringsANewLine) {
  const base::Descriptor client = open_client(link);
  host.unplug();
  EXPECT_FALSE(host.plugged());
  EXPECT_EQ(host.write(bytes_of("x")), 0U);
  char byte = 0;
  EXPECT_EQ(::read(client.get(), &byte, 1), 0) << "end of file";
  host.replug();
  const base::Descriptor again = open_client(link);
  host.write(bytes_of("back"));
  EXPECT_EQ(read_some(again), "back");
}

}  // namespace
}  // namespace navcal::ports::testing
