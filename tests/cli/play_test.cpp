// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "emulate_program.h"
#include "tests/ports/harness.h"

namespace navcal::cli::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

struct Play : ::testing::Test {
  ports::testing::Folder folder;
  fs::path dir = folder.path() / "ports";

  fs::path capture(const std::string& lines) const {
    const fs::path file = folder.path() / "dive.cap";
    std::ofstream(file) << "#capture 1\n#port compass tcm2 38400\n#port imu imu-card 57600\n" << lines;
    return file;
  }
};

TEST_F(Play, GivesBackTheBytesOfEachPortAndEnds) {
  const fs::path file = capture(
      "1700000000.000000000 compass < 2443\n"
      "1700000000.100000000 imu < a55a00ff1104\n"
      "1700000000.150000000 compass > 680d\n"
      "1700000000.200000000 compass < 33322e31\n");
  Program program({"play", file.string(), "--dir", dir.string()});
  ASSERT_EQ(program.line(), "ready");
  Client compass(dir / "compass");
  Client imu(dir / "imu");
  EXPECT_EQ(imu.read_until("\x04"), std::string("\xA5\x5A\x00\xFF\x11\x04", 6));
  EXPECT_EQ(compass.read_all(), "$C32.1");
  EXPECT_EQ(imu.read_all().size(), 6U);
  EXPECT_EQ(program.wait(), 0);
  EXPECT_TRUE(fs::is_empty(dir));
  EXPECT_NE(program.errors().find("compass: 6 bytes taken\n"), std::string::npos);
}

TEST_F(Play, KeepsThePaceTimesTheSpeed) {
  const fs::path file = capture("1700000000.000000000 compass < 61\n1700000004.000000000 compass < 62\n");
  Program program({"play", file.string(), "--dir", dir.string(), "--speed", "10", "--wait", "0.01"});
  ASSERT_EQ(program.line(), "ready");
  const auto start = steady_clock::now();
  Client compass(dir / "compass");
  EXPECT_EQ(compass.read_until("b").back(), 'b');
  EXPECT_GE(steady_clock::now() - start, std::chrono::milliseconds(350)) << "never sooner than recorded";
  EXPECT_EQ(program.wait(), 0);
}

TEST_F(Play, WhatNobodyTakesIsCountedAndDoesNotHoldItUp) {
  std::string lines;
  for (int i = 0; i < 50; ++i) lines += "1700000000.000000000 imu < " + std::string(8192, 'a') + "\n";
  Program program({"play", capture(lines).string(), "--dir", dir.string(), "--wait", "0"});
  EXPECT_EQ(program.line(), "ready");
  EXPECT_EQ(program.wait(), 0);
  const std::string errors = program.errors();
  EXPECT_NE(errors.find("imu: 0 bytes taken, 204800 lost because nobody had it open"), std::string::npos)
      << errors;
}

TEST_F(Play, BadInputAndWrongUsageHaveTheirStatuses) {
  EXPECT_EQ(Program({"play", "/nowhere.cap", "--dir", dir.string()}).wait(), 3);
  EXPECT_EQ(
      Program({"play", capture("1700000000.000000000 compass < 6\n1700000001.000000000 compass < 61\n").string(),
               "--dir", dir.string(), "--wait", "0"})
          .wait(),
      3);
  EXPECT_EQ(Program({"play", "--dir", dir.string()}).wait(), 2);
  EXPECT_EQ(Program({"play", capture("").string(), "--dir", dir.string(), "--speed", "0"}).wait(), 2);
}

TEST(Ports, ListsOrSaysThatThereAreNone) {
  Program program({"ports", "--json"});
  const std::string first = program.line();
  EXPECT_EQ(program.wait(), 0);
  if (first.empty()) {
    EXPECT_NE(program.errors().find("no serial ports"), std::string::npos);
  } else {
    EXPECT_EQ(first.rfind(R"({"class":"PORT","path":"/dev/)", 0), 0U) << first;
  }
}

}  // namespace
}  // namespace navcal::cli::test
