// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/pressure_gauges.h"

#include <gtest/gtest.h>

#include "tests/sim/drive.h"

namespace navcal::sim {
namespace {

using testing::kSecond_ns;
using testing::kStart_ns;
using testing::Still;
namespace keller = protocols::keller;

Still at_depth(double depth_m) {
  Still motion;
  motion.state.position_m = {0, 0, depth_m};
  return motion;
}

std::string text_of_bytes(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(Pressure, IsAbsolute) {
  EXPECT_NEAR(absolute_pressure_Pa(at_depth(0).state), 101325, 1e-9);
  EXPECT_NEAR(absolute_pressure_Pa(at_depth(10).state), 101325 + 1025 * 10 * kGravity_m_s2, 1e-9);
}

TEST(ParoscientificEmulator, AnswersAndSendsUntilTheNextCommand) {
  const Still motion = at_depth(10);
  ParoscientificEmulator::Options options;
  options.noise_Pa = 0;
  options.unit = 4;
  ParoscientificEmulator gauge(options, motion);
  std::int64_t now_ns = kStart_ns;
  gauge.power_on(now_ns);
  EXPECT_EQ(testing::text_of(testing::run_to(gauge, now_ns += 5 * kSecond_ns)), "") << "silent as delivered";
  EXPECT_EQ(testing::say(gauge, now_ns, "*0100UN\r\n"), "*0001UN=4\r\n");
  EXPECT_EQ(testing::say(gauge, now_ns, "*0200UN\r\n"), "") << "another gauge is meant";
  EXPECT_EQ(testing::say(gauge, now_ns, "*0100P3\r\n", 1), "*0001201.87750\r\n");
  std::string three = testing::say(gauge, now_ns, "*0100P4\r\n", 2.1);
  EXPECT_EQ(three, "*0001201.87750\r\n*0001201.87750\r\n*0001201.87750\r\n");
  EXPECT_EQ(testing::say(gauge, now_ns, "*0100VR\r\n", 3), "*0001VR=R5.10\r\n") << "any command ends the values";
  EXPECT_EQ(testing::say(gauge, now_ns, "*0100P4\r\n", 0.7), "*0001201.87750\r\n");
  gauge.power_on(now_ns);
  EXPECT_EQ(testing::text_of(testing::run_to(gauge, now_ns += 5 * kSecond_ns)), "");
}

TEST(KellerEmulator, AnswersAtItsAddressOnceItIsInitialised) {
  const Still motion = at_depth(10);
  KellerEmulator::Options options;
  options.noise_Pa = 0;
  options.address = 7;
  KellerEmulator transmitter(options, motion);
  std::int64_t now_ns = kStart_ns;
  transmitter.power_on(now_ns);
  const auto ask = [&](const std::vector<std::uint8_t>& request) {
    const std::string answer = testing::say(transmitter, now_ns, text_of_bytes(request));
    return std::vector<std::uint8_t>(answer.begin(), answer.end());
  };
  EXPECT_EQ(ask(keller::read_request(7, 1)), keller::encode(keller::Refusal{7, 73, 32}));
  EXPECT_TRUE(ask(keller::initialise_request(3)).empty()) << "another one is meant";
  EXPECT_EQ(keller::decode_identity(ask(keller::initialise_request(250))).value().state, 0);
  EXPECT_EQ(keller::decode_identity(ask(keller::initialise_request(7))).value().state, 1);
  const auto reading = keller::decode_reading(ask(keller::read_request(7, 1)));
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->value, 2.018775, 1e-6);
  EXPECT_EQ(ask(keller::read_request(7, 9)), keller::encode(keller::Refusal{7, 73, 2}));
  transmitter.power_on(now_ns);
  EXPECT_EQ(ask(keller::read_request(7, 1)), keller::encode(keller::Refusal{7, 73, 32}));
}

TEST(KellerEmulator, TheConverterCanReturnWhatTheHostSays) {
  const Still motion = at_depth(0);
  KellerEmulator::Options options;
  options.echoes = true;
  KellerEmulator transmitter(options, motion);
  std::int64_t now_ns = kStart_ns;
  transmitter.power_on(now_ns);
  const std::string request = text_of_bytes(keller::initialise_request(250));
  const std::string heard = testing::say(transmitter, now_ns, request);
  EXPECT_EQ(heard.substr(0, request.size()), request);
  EXPECT_EQ(heard.size(), request.size() + 10);
}

}  // namespace
}  // namespace navcal::sim
