// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/oncore.h"

#include <gtest/gtest.h>

#include <cmath>

#include "protocols/oncore_messages.h"
#include "protocols/oncore_position.h"
#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

using Kind = Oncore::Kind;

struct EmulatedOncore : ::testing::Test {
  Still motion;
  std::int64_t t_ns = kStart_ns;
  Oncore::Options options;
  std::unique_ptr<Oncore> receiver;

  void power(Kind kind = Kind::twelve_channels) {
    options.kind = kind;
    receiver = std::make_unique<Oncore>(options, motion);
    receiver->power_on(t_ns);
  }
  void ask(protocols::FrameId id, std::uint8_t rate) {
    receiver->on_bytes(t_ns, protocols::oncore::encode_poll(id, rate));
  }
  std::vector<Emission> run(double seconds) {
    t_ns += static_cast<std::int64_t>(seconds * 1e9);
    return run_to(*receiver, t_ns);
  }
  static std::string ids(const std::vector<Emission>& emissions) {
    std::string text;
    for (const Emission& emission : emissions)
      text.append({static_cast<char>(emission.bytes[2]), static_cast<char>(emission.bytes[3]), ' '});
    return text;
  }
};

TEST_F(EmulatedOncore, IsSilentUntilAskedAndSendsThreeTenthsAfterTheSecond) {
  power();
  EXPECT_TRUE(run(5).empty());
  ask(protocols::oncore::kHa, 1);
  const auto messages = run(3);
  ASSERT_EQ(messages.size(), 3U);
  for (const Emission& message : messages) {
    EXPECT_EQ(message.start_ns % kSecond_ns, 300'000'000);
    const auto position = protocols::oncore::decode_position(message.bytes);
    ASSERT_TRUE(position && position->in_range);
    EXPECT_EQ(protocols::unix_ns(position->date, position->time), message.start_ns - 300'000'000);
  }
}

TEST_F(EmulatedOncore, RatesAndPolls) {
  power();
  ask(protocols::oncore::kEa, 2);
  ask(protocols::oncore::kBb, 1);
  ask(protocols::oncore::kBo, 0);
  EXPECT_EQ(ids(run(4)), "Ea Bb Bo Bb Ea Bb ");
  ask(protocols::oncore::kEa, 0);  // once, and no more
  EXPECT_EQ(ids(run(3)), "Ea Bb Bb Bb ");
  ask(protocols::oncore::kBb, 0);
  ask(protocols::oncore::kCj, 0);
  EXPECT_EQ(ids(run(3)), "Bb Cj ");
}

TEST_F(EmulatedOncore, MalformedCommandsAreDroppedSilently) {
  power();
  auto command = protocols::oncore::encode_poll(protocols::oncore::kHa, 1);
  command[5] ^= 1;  // the checksum
  receiver->on_bytes(t_ns, command);
  receiver->on_bytes(t_ns, bytes_of("garbage@@"));
  EXPECT_TRUE(run(3).empty());
  ask(protocols::oncore::kHa, 1);
  EXPECT_EQ(run(1).size(), 1U) << "and a good one after them is understood";
}

TEST_F(EmulatedOncore, AnOlderReceiverDoesNotKnowHa) {
  power(Kind::eight_channels);
  ask(protocols::oncore::kHa, 1);
  EXPECT_TRUE(run(3).empty());
  ask(protocols::oncore::kEa, 1);
  EXPECT_EQ(ids(run(2)), "Ea Ea ");
}

TEST_F(EmulatedOncore, ForgetsWhatItWasAskedWithThePower) {
  power();
  ask(protocols::oncore::kHa, 1);
  EXPECT_FALSE(run(2).empty());
  receiver->power_on(t_ns);
  EXPECT_TRUE(run(3).empty());
}

TEST_F(EmulatedOncore, FindsItselfTwoToTenSecondsAfterSurfacingAndNotBelow) {
  motion.state.position_m = {100, 50, 0.2};
  motion.state.velocity_body_m_s = {1, 0, 0};
  motion.state.euler_rad[2] = 1;
  power();
  ask(protocols::oncore::kHa, 1);
  for (int round = 0; round < 3; ++round) {
    int seconds = 0;
    protocols::oncore::Position position;
    while (seconds < 30 && position.fix != protocols::Fix::fix_3d) {
      const auto messages = run(1);
      if (messages.empty()) continue;
      ++seconds;
      position = *protocols::oncore::decode_position(messages.at(0).bytes);
    }
    EXPECT_GE(seconds, 2);
    EXPECT_LE(seconds, 15) << "three flat fixes come first";
    EXPECT_NEAR(position.filtered.latitude_deg, options.receiver.origin.latitude_deg + 100 / 110990.0, 6e-5);
    EXPECT_NEAR(position.filtered.longitude_deg, options.receiver.origin.longitude_deg + 50 / 88920.0, 6e-5);
    EXPECT_NEAR(position.speed_m_s, 1, 0.5);
    EXPECT_NEAR(position.heading_deg, 57.3, 30);
    motion.state.position_m[2] = 0.4;
    const auto submerged = protocols::oncore::decode_position(run(2).back().bytes);
    EXPECT_EQ(submerged->fix, protocols::Fix::acquiring);
    motion.state.position_m[2] = 0.2;
  }
}

TEST_F(EmulatedOncore, RolloverAndUnknownLeapSeconds) {
  options.weeks_early = 1024;
  options.leap_seconds_known = false;
  power();
  ask(protocols::oncore::kEa, 1);
  ask(protocols::oncore::kBo, 1);
  const auto messages = run(1.6);
  ASSERT_EQ(messages.size(), 2U);
  const auto position = protocols::oncore::decode_position(messages[0].bytes);
  const std::int64_t second_ns = messages[0].start_ns - 300'000'000;
  EXPECT_EQ(protocols::unix_ns(position->date, position->time),
            second_ns + 18 * kSecond_ns - 1024 * 604800 * kSecond_ns);
  EXPECT_FALSE(protocols::oncore::decode_bo(messages[1].bytes)->offset_s);
}

TEST_F(EmulatedOncore, TodaysReceiverSpeaksNmeaUnasked) {
  power(Kind::nmea);
  const std::string text = text_of(run(1.6));
  for (const char* sentence : {"$GPGGA,", "$GPRMC,", "$GPGSA,", "$GPGSV,"}) {
    EXPECT_NE(text.find(sentence), std::string::npos) << sentence;
  }
}

}  // namespace
}  // namespace navcal::sim::testing
