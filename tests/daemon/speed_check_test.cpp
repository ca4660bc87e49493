// SPDX-License-Identifier: Apache-2.0
#include "daemon/speed_check.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace navcal::daemon {
namespace {

using protocols::Counters;
using protocols::Protocol;
using Verdict = SpeedCheck::Verdict;

/// Bytes that a UART at `factor` times the sender's speed reads: each of its bits samples the line at that time.
std::vector<std::uint8_t> at_wrong_speed(const std::string& text, double factor) {
  std::vector<bool> line(20, true);
  for (const char c : text) {
    line.push_back(false);
    for (int bit = 0; bit < 8; ++bit) line.push_back((static_cast<unsigned char>(c) >> bit & 1) != 0);
    line.push_back(true);
  }
  line.insert(line.end(), 20, true);
  const auto level = [&](double at) {
    return at >= static_cast<double>(line.size()) || line[static_cast<std::size_t>(at)];
  };
  std::vector<std::uint8_t> bytes;
  double at = 0;
  while (at < static_cast<double>(line.size())) {
    if (level(at)) {
      at += 0.1;
      continue;
    }
    unsigned byte = 0;
    for (int bit = 0; bit < 8; ++bit) byte |= (level(at + (1.5 + bit) / factor) ? 1U : 0U) << bit;
    bytes.push_back(static_cast<std::uint8_t>(byte));
    at += 9.5 / factor;
    while (!level(at)) at += 0.1;  // waits for the stop bit
  }
  return bytes;
}

std::string words() {
  std::string text;
  for (int i = 0; i < 60; ++i) text += "$C328.3P28.4R-12.4X55.11Y12.33Z-18.43T22.3*2C\r\n";
  return text;
}

Counters skipped(std::size_t n) {
  Counters counters;
  counters.bytes = counters.skipped_bytes = n;
  return counters;
}

TEST(SpeedCheck, EveryWrongSpeedOfTheTableIsRecognised) {
  for (const double factor : {0.25, 0.5, 2.0, 3.0, 4.0, 6.0}) {
    const auto bytes = at_wrong_speed(words() + words() + words() + words(), factor);
    SpeedCheck check(Protocol::tcm2, 9600);
    check.bytes(bytes);
    EXPECT_EQ(check.judge(skipped(bytes.size())), Verdict::wrong_speed) << factor;
    EXPECT_NE(check.message().find("no intact frame: wrong speed? (configured 9600)"), std::string::npos);
  }
}

TEST(SpeedCheck, AnotherDeviceIsNotCalledAWrongSpeed) {
  const std::string text = words();
  SpeedCheck check(Protocol::motor_card, 19200);
  check.bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  EXPECT_EQ(check.judge(skipped(text.size())), Verdict::no_frames);
  EXPECT_NE(check.message().find("motor-card"), std::string::npos);
}

TEST(SpeedCheck, SentencesWithoutAChecksumAreCalledThat) {
  const std::string text(400, 'x');
  Counters counters = skipped(text.size());
  counters.bad_checksum = 9;
  SpeedCheck check(Protocol::nmea, 4800);
  check.bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  EXPECT_EQ(check.judge(counters), Verdict::no_frames);
  EXPECT_NE(check.message().find("9 sentences, none with a checksum that holds"), std::string::npos);
  EXPECT_NE(check.message().find("require_checksum"), std::string::npos);
}

TEST(SpeedCheck, NoiseLeavesSomeFramesIntact) {
  std::mt19937 random(6);
  std::vector<std::uint8_t> bytes(1000);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  SpeedCheck check(Protocol::tcm2, 9600);
  check.bytes(bytes);
  Counters counters;
  counters.bytes = 1000;
  counters.frames = 8;
  counters.framed_bytes = 400;
  counters.skipped_bytes = 600;
  EXPECT_EQ(check.judge(counters), Verdict::noise);
  EXPECT_EQ(check.message(), "noise: 600 of 1000 bytes belong to no frame");
}

TEST(SpeedCheck, TooLittleSaysNothingAndIsKeptForLater) {
  SpeedCheck check(Protocol::imu_card, 57600);
  const std::vector<std::uint8_t> bytes(100, 0xff);
  std::size_t total = 0;
  for (int i = 0; i < 3; ++i) {
    check.bytes(bytes);
    total += bytes.size();
    EXPECT_EQ(check.judge(skipped(total)), Verdict::good);
  }
  check.bytes(bytes);
  EXPECT_EQ(check.judge(skipped(total + 100)), Verdict::wrong_speed);
}

TEST(SpeedCheck, TheFirstIntactFrameClearsTheSuspicion) {
  SpeedCheck check(Protocol::imu_card, 57600);
  check.bytes(std::vector<std::uint8_t>(500, 0xff));
  ASSERT_EQ(check.judge(skipped(500)), Verdict::wrong_speed);
  Counters counters = skipped(500);
  counters.frames = 1;
  EXPECT_EQ(check.judge(counters), Verdict::good);
  EXPECT_TRUE(check.message().empty());
}

}  // namespace
}  // namespace navcal::daemon
