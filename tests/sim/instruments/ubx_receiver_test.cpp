// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/ubx_receiver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "protocols/ubx_navigation.h"
#include "protocols/ubx_receiver.h"
#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

namespace ubx = protocols::ubx;
using Generation = UbxReceiver::Generation;
using ubx::ReceiverPort;

struct EmulatedUbx : ::testing::Test {
  Still motion;
  std::int64_t t_ns = kStart_ns;
  UbxReceiver::Options options;
  std::unique_ptr<UbxReceiver> receiver;

  void power(Generation generation = Generation::nine) {
    options.generation = generation;
    options.receiver.gps.timing = devices::usual_timing(protocols::Protocol::ubx, options.baud);
    receiver = std::make_unique<UbxReceiver>(options, motion);
    receiver->power_on(t_ns);
  }
  std::vector<Emission> run(double seconds) {
    t_ns += static_cast<std::int64_t>(seconds * 1e9);
    return run_to(*receiver, t_ns);
  }
  /// Hands over a command and answers whether it was accepted; nullopt without an answer.
  std::optional<bool> tell(const std::vector<std::uint8_t>& command) {
    receiver->on_bytes(t_ns, command);
    for (const Emission& emission : run(0.1)) {
      if (const auto answer = ubx::decode_acknowledgement(emission.bytes)) return answer->accepted;
    }
    return std::nullopt;
  }
  static std::string ids(const std::vector<Emission>& emissions) {
    std::string text;
    for (const Emission& emission : emissions) {
      const protocols::Frame frame{{}, 0, emission.bytes};
      const auto code = ubx::code_of(frame);
      text += std::string(code ? ubx::id_of(*code).view() : "NMEA") + ' ';
    }
    return text;
  }
  static std::vector<ubx::NavPvt> fixes(const std::vector<Emission>& emissions) {
    std::vector<ubx::NavPvt> found;
    for (const Emission& emission : emissions) {
      if (const auto pvt = ubx::decode_nav_pvt(emission.bytes)) found.push_back(*pvt);
    }
    return found;
  }
};

TEST_F(EmulatedUbx, SendsNmeaAsDelivered) {
  power();
  EXPECT_EQ(ids(run(3.5)), "NMEA NMEA NMEA ");
}

TEST_F(EmulatedUbx, GenerationNineTakesValuesWholeOrNotAtAll) {
  power();
  const auto pvt = ubx::key_of_message(ubx::kNavPvt, ReceiverPort::uart1);
  EXPECT_EQ(tell(ubx::encode_cfg_valset(ubx::ram, std::vector<ubx::ConfigurationItem>{{pvt, 1}, {0x20FFFFFF, 1}})),
            false);
  EXPECT_EQ(ids(run(1)), "NMEA ");
  EXPECT_EQ(tell(ubx::encode_cfg_valset(
                ubx::ram,
                std::vector<ubx::ConfigurationItem>{{pvt, 1},
                                                    {ubx::kRateMeasurement_ms, 500},
                                                    {ubx::key_of_message(ubx::kNavSat, ReceiverPort::uart1), 2},
                                                    {ubx::key_of_nmea_output(ReceiverPort::uart1), 0}})),
            true);
  EXPECT_EQ(ids(run(3)).find("NMEA"), std::string::npos);
  const std::string text = ids(run(2));
  EXPECT_TRUE(text == "NAV-PVT NAV-SAT NAV-PVT NAV-PVT NAV-SAT NAV-PVT " ||
              text == "NAV-PVT NAV-PVT NAV-SAT NAV-PVT NAV-PVT NAV-SAT ")
      << text;
}

TEST_F(EmulatedUbx, ValuesForAnotherPortChangeNothingHere) {
  options.port = ReceiverPort::usb;
  power();
  EXPECT_EQ(tell(ubx::encode_cfg_valset(
                ubx::ram,
                std::vector<ubx::ConfigurationItem>{{ubx::key_of_message(ubx::kNavPvt, ReceiverPort::uart1), 1}})),
            true);
  EXPECT_EQ(ids(run(1)), "NMEA ");
}

TEST_F(EmulatedUbx, OlderGenerationsTakeSingleMessages) {
  power(Generation::eight);
  EXPECT_EQ(tell(ubx::encode_cfg_valset(ubx::ram, {})), false);
  EXPECT_EQ(tell(ubx::encode_cfg_msg({ubx::kNavPvt, 1})), true);
  EXPECT_EQ(tell(ubx::encode_cfg_msg({0xF000, 0})), true);
  EXPECT_EQ(tell(ubx::encode_cfg_rate({200, 1})), true);
  EXPECT_EQ(tell(ubx::encode_cfg_msg({0x0199, 1})), false);
  run(2);
  EXPECT_EQ(ids(run(1)), "NAV-PVT NAV-PVT NAV-PVT NAV-PVT NAV-PVT ");
  power(Generation::six);
  EXPECT_EQ(tell(ubx::encode_cfg_msg({ubx::kNavPvt, 1})), false);
  EXPECT_EQ(ids(run(1)), "NMEA ");
}

TEST_F(EmulatedUbx, PowerTakesTheConfiguration) {
  power(Generation::eight);
  EXPECT_EQ(tell(ubx::encode_cfg_msg({ubx::kNavPvt, 1})), true);
  receiver->power_on(t_ns);
  EXPECT_EQ(ids(run(2)), "NMEA NMEA ");
}

TEST_F(EmulatedUbx, StatesItsVersion) {
  power();
  receiver->on_bytes(t_ns, ubx::encode_frame(ubx::kMonVer, {}));
  const auto emissions = run(0.1);
  ASSERT_EQ(emissions.size(), 1U);
  const auto version = ubx::decode_mon_ver(emissions[0].bytes);
  ASSERT_TRUE(version);
  EXPECT_EQ(version->extensions.back(), "PROTVER=27.11");
}

TEST_F(EmulatedUbx, TheTimeIsThatOfTheFixAndTheErrorsAreThoseOfTheNoise) {
  motion.state.velocity_body_m_s = {3, 0, 0};
  power(Generation::eight);
  EXPECT_EQ(tell(ubx::encode_cfg_msg({ubx::kNavPvt, 1})), true);
  run(60);
  const auto emissions = run(400);
  const auto all = fixes(emissions);
  ASSERT_EQ(all.size(), 400U);
  double sum_m2 = 0, stated_m2 = 0;
  const double origin_deg = options.receiver.origin.latitude_deg;
  for (const ubx::NavPvt& pvt : all) {
    EXPECT_EQ(pvt.fix_type, 3);
    ASSERT_TRUE(pvt.utc_ns());
    EXPECT_EQ((*pvt.utc_ns() - options.clock_error_ns) % kSecond_ns, 0);
    EXPECT_EQ(pvt.nanosecond, options.clock_error_ns);
    const double north_m = (pvt.latitude_deg - origin_deg) * 111e3;
    sum_m2 += north_m * north_m;
    stated_m2 += pvt.horizontal_accuracy_m * pvt.horizontal_accuracy_m / 2;
    EXPECT_NEAR(pvt.velocity_ned_m_s[0], 3, 0.5);
  }
  EXPECT_NEAR(std::sqrt(sum_m2 / stated_m2), 1, 0.15);
  // NAV-PVT begins one latency after the second, behind the sentences of the same second.
  EXPECT_GE(emissions.front().start_ns % kSecond_ns, 50'000'000);
}

TEST_F(EmulatedUbx, BelowTheSurfaceThereIsNoFixButTheTime) {
  power(Generation::eight);
  EXPECT_EQ(tell(ubx::encode_cfg_msg({ubx::kNavPvt, 1})), true);
  run(60);
  motion.state.position_m[2] = 5;
  run(1);
  const auto all = fixes(run(5));
  ASSERT_FALSE(all.empty());
  for (const ubx::NavPvt& pvt : all) {
    EXPECT_EQ(pvt.fix(), protocols::Fix::none);
    EXPECT_TRUE(pvt.utc_ns());
    EXPECT_EQ(pvt.satellites, 0);
  }
}

}  // namespace
}  // namespace navcal::sim::testing
