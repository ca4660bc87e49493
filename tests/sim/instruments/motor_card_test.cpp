// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/motor_card.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

struct EmulatedMotorCard : ::testing::Test {
  Still motion;
  MotorCard card{quiet(), motion};
  std::int64_t t_ns = kStart_ns;

  static MotorCard::Options quiet() {
    MotorCard::Options options;
    options.motor = devices::without_noise({}).motor;
    return options;
  }
  EmulatedMotorCard() {
    motion.state.rpm = motion.state.rpm_commanded = 720;
    motion.state.fins_rad = {0.1, -0.05, 0};
    motion.state.motor_current_A = 1.1;
    card.power_on(t_ns);
  }
  protocols::motor_card::Status status_after(double seconds) {
    t_ns += static_cast<std::int64_t>(seconds * 1e9);
    const auto lines = run_to(card, t_ns);
    const auto status = protocols::motor_card::decode_status(lines.back().bytes);
    EXPECT_TRUE(status);
    return status.value_or(protocols::motor_card::Status{});
  }
  void command(std::int32_t rpm, std::array<double, 3> fins_deg) {
    card.on_bytes(t_ns, protocols::motor_card::encode_command({rpm, fins_deg}));
  }
};

TEST_F(EmulatedMotorCard, TellsWhatTheVehicleDoesTenTimesASecond) {
  EXPECT_EQ(run_to(card, kStart_ns + kSecond_ns).size(), 10U);
  t_ns = kStart_ns + kSecond_ns;
  const protocols::motor_card::Status status = status_after(0.1);
  EXPECT_EQ(status.sequence, 10);
  EXPECT_EQ(status.rpm, 720);
  EXPECT_EQ(status.rpm_commanded, 720);
  EXPECT_NEAR(*status.fins_deg[0], 5.7, 1e-9);
  EXPECT_NEAR(*status.fins_deg[1], -2.9, 1e-9);
  EXPECT_NEAR(*status.current_A, 1.1, 1e-9);
}

TEST_F(EmulatedMotorCard, FollowsACommandAndSaysSoInTheNextStatus) {
  t_ns += kSecond_ns;
  run_to(card, t_ns);
  command(900, {10, -5, -5});
  EXPECT_EQ(status_after(0.1).rpm_commanded, 900);
  const protocols::motor_card::Status settled = status_after(5);
  EXPECT_EQ(settled.rpm, 900);
  EXPECT_NEAR(*settled.current_A, 0.15 + 5.5e-4 * std::pow(15, 3), 0.005);
  EXPECT_NEAR(*settled.fins_deg[0], 10, 0.05);
}

TEST_F(EmulatedMotorCard, RefusesFinsBeyondTheirLimitAndBrokenLines) {
  command(900, {25.1, 0, 0});
  card.on_bytes(t_ns, bytes_of("$MCC,900,1,1,1*00\r\n"));
  EXPECT_EQ(card.refused(), 1U);
  EXPECT_EQ(status_after(1).rpm_commanded, 720);
  command(100, {25, -25, 0});
  EXPECT_EQ(status_after(1).rpm_commanded, 100) << "the limit itself is allowed";
}

TEST_F(EmulatedMotorCard, HandsOrdersToAVehicleThatObeysAndTellsWhatThatDoes) {
  std::vector<protocols::motor_card::Command> orders;
  MotorCard::Options options = quiet();
  options.obey = [&](std::int64_t, const protocols::motor_card::Command& order) { orders.push_back(order); };
  MotorCard driving(options, motion);
  driving.power_on(t_ns);
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders.back(), protocols::motor_card::Command{}) << "power comes: shaft off, fins neutral";
  driving.on_bytes(t_ns, protocols::motor_card::encode_command({900, {10, -5, -5}}));
  driving.on_bytes(t_ns, protocols::motor_card::encode_command({900, {25.1, 0, 0}}));
  ASSERT_EQ(orders.size(), 2U) << "the second is refused";
  EXPECT_EQ(orders.back().rpm, 900);
  EXPECT_NEAR(orders.back().fins_deg[0], 10, 1e-9);
  const auto lines = run_to(driving, t_ns + kSecond_ns);
  const auto status = protocols::motor_card::decode_status(lines.back().bytes);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->rpm, 720) << "the vehicle's, whatever was ordered";
}

TEST_F(EmulatedMotorCard, ForgetsItsCommandWithThePower) {
  command(900, {0, 0, 0});
  card.power_on(t_ns + kSecond_ns);
  EXPECT_EQ(status_after(3).rpm_commanded, 720);
}

}  // namespace
}  // namespace navcal::sim::testing
