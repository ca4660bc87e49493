// SPDX-License-Identifier: Apache-2.0
#include "record/log/checked_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <random>

#include "record/json/base64.h"
#include "tests/record/temporary_folder.h"

namespace navcal::record {
namespace {

using State = CheckedContent::State;
using CheckedFile = testing::TemporaryFolder;

TEST_F(CheckedFile, GivesBackWhatWasWritten) {
  const auto file = write("state", "");
  std::filesystem::remove(file);
  EXPECT_EQ(read_checked(file).state, State::absent);
  const std::string content("any \0 bytes\n", 12);
  ASSERT_FALSE(write_checked(file, content));
  EXPECT_EQ(read_checked(file).state, State::good);
  EXPECT_EQ(read_checked(file).content, content);
  ASSERT_FALSE(write_checked(file, ""));
  EXPECT_EQ(read_checked(file).content, "");
}

TEST_F(CheckedFile, TellsDamageOfAnyByteAndAnyCut) {
  const auto file = write("state", "");
  ASSERT_FALSE(write_checked(file, "what was learnt"));
  std::ifstream in(file, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 4);
    EXPECT_EQ(read_checked(write("bad", bad)).state, State::damaged) << i;
    EXPECT_FALSE(read_checked(write("bad", bad)).reason.empty());
    EXPECT_EQ(read_checked(write("cut", good.substr(0, i))).state, State::damaged) << i;
  }
}

TEST_F(CheckedFile, KilledAtAnyInstantItHoldsTheOldOrTheNewContent) {
  const auto file = write("state", "");
  ASSERT_FALSE(write_checked(file, std::string(20'000, 'a')));
  std::mt19937 random(1);
  for (int round = 0; round < 30; ++round) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (char c = 'a';; c = c == 'z' ? 'a' : static_cast<char>(c + 1))
        (void)write_checked(file, std::string(20'000, c));
    }
    ::usleep(static_cast<useconds_t>(random() % 20'000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const auto read = read_checked(file);
    ASSERT_EQ(read.state, State::good) << read.reason;
    ASSERT_EQ(read.content.size(), 20'000U);
    EXPECT_EQ(read.content.find_first_not_of(read.content.front()), std::string::npos);
  }
}

TEST_F(CheckedFile, AFolderInItsPlaceIsDamage) {
  const auto file = write("state", "");
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  EXPECT_EQ(read_checked(file).state, State::damaged);
  EXPECT_TRUE(write_checked(file, "x"));
}

TEST_F(CheckedFile, AFolderThatIsNotThereIsAnError) {
  EXPECT_TRUE(write_checked("/nowhere/at/all", "x"));
  EXPECT_EQ(read_checked("/nowhere/at/all").state, State::absent);
}

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  std::mt19937 random(5);
  for (std::size_t length = 0; length < 100; ++length) {
    std::string bytes;
    while (bytes.size() < length) bytes += static_cast<char>(random());
    EXPECT_EQ(from_base64(base64(bytes)), bytes);
  }
  for (const char* none : {"Z", "Zg=", "Z===", "Zm9?", "Zg==Zg=="}) EXPECT_FALSE(from_base64(none)) << none;
}

}  // namespace
}  // namespace navcal::record
