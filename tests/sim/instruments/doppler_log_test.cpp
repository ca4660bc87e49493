// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>

#include "protocols/pd6.h"
#include "protocols/water_linked.h"
#include "sim/instruments/doppler_devices.h"
#include "tests/sim/drive.h"

namespace navcal::sim {
namespace {

using testing::kSecond_ns;
using testing::kStart_ns;
using testing::Still;
namespace pd0 = protocols::pd0;
namespace water_linked = protocols::water_linked;

/// Keeps the pings.
struct RecordingLog : DopplerLog {
  using DopplerLog::DopplerLog;
  mutable std::vector<DopplerPing> pings;
  mutable std::vector<std::int64_t> sent_ns;

 protected:
  [[nodiscard]] std::vector<std::uint8_t> encode(const DopplerPing& ping, std::int64_t now_ns) const override {
    pings.push_back(ping);
    sent_ns.push_back(now_ns);
    return {0};
  }
};

DopplerLog::Options exact() {
  DopplerLog::Options options;
  options.beam_noise_m_s = options.scale_error = options.range_noise_m = 0;
  return options;
}

std::vector<DopplerPing> pings_of(const DopplerLog::Options& options, const Motion& motion, int seconds = 1) {
  RecordingLog log(options, motion);
  log.power_on(kStart_ns);
  testing::run_to(log, kStart_ns + seconds * kSecond_ns);
  return log.pings;
}

TEST(DopplerLog, BeamsSeeTheVelocityOverTheBottom) {
  Still motion;
  motion.state.euler_rad = {0.1, -0.2, 1.5707963267948966};
  motion.state.velocity_body_m_s = {1.5, 0.1, -0.05};
  motion.state.current_m_s = {0, 0.5};  // to the east, where the bow points
  const auto pings = pings_of(exact(), motion);
  ASSERT_EQ(pings.size(), 5U);
  const Vector3 over_bottom = velocity_over_bottom_m_s(motion.state);
  EXPECT_NEAR(over_bottom[0], 1.5 + 0.5 * std::cos(0.2), 1e-9);
  const DopplerSolution solution = solved(pings[0], exact().beam_angle_rad);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(solution.body_m_s[i], over_bottom[i], 1e-9) << i;
  EXPECT_NEAR(solution.error_m_s, 0, 1e-9);
  // The forward beam of a vehicle whose nose points down is the shorter one.
  EXPECT_LT(*pings[0].range_m[2], *pings[0].range_m[3]);
}

TEST(DopplerLog, RangesOfALevelVehicleAreThoseToTheFloor) {
  Still motion;
  motion.state.position_m = {0, 0, 8};
  auto options = exact();
  options.floor = {18, 0, 0};
  const auto ping = pings_of(options, motion).front();
  for (const auto& range_m : ping.range_m) EXPECT_NEAR(*range_m * std::cos(options.beam_angle_rad), 10, 1e-9);
  options.floor.slope_north = 0.1;  // it falls away to the north, where beam 3 points
  const auto sloping = pings_of(options, motion).front();
  EXPECT_GT(*sloping.range_m[2], *sloping.range_m[3]);
}

TEST(DopplerLog, BottomLockIsLostBeyondTheRangeAndNextToTheBottom) {
  Still motion;
  auto options = exact();
  options.floor.depth_m = 60;
  EXPECT_FALSE(pings_of(options, motion).front().has_lock());
  options.floor.depth_m = 40;
  EXPECT_TRUE(pings_of(options, motion).front().has_lock());
  motion.state.position_m[2] = 39.9;
  EXPECT_FALSE(pings_of(options, motion).front().has_lock());
  // Rolled by 30 degrees, one beam looks sideways.
  motion.state.position_m[2] = 10;
  motion.state.euler_rad[0] = 0.6;
  const auto tilted = pings_of(options, motion).front();
  EXPECT_FALSE(tilted.velocity_m_s[0].has_value());
  EXPECT_TRUE(tilted.velocity_m_s[1].has_value());
}

TEST(DopplerLog, NoiseAndScaleAreAsConfigured) {
  Still motion;
  motion.state.velocity_body_m_s = {2, 0, 0};
  DopplerLog::Options options = exact();
  options.scale_error = 0.01;
  options.beam_noise_m_s = 0.005;
  const auto pings = pings_of(options, motion, 400);
  double mean = 0, square = 0;
  for (const DopplerPing& ping : pings) {
    const double error = solved(ping, options.beam_angle_rad).body_m_s[0] - 2;
    mean += error / static_cast<double>(pings.size());
    square += error * error / static_cast<double>(pings.size());
  }
  EXPECT_NEAR(mean, 0.02, 0.001);
  EXPECT_NEAR(std::sqrt(square - mean * mean), 0.005 * std::sqrt(2), 0.0005) << "two beams at 30 degrees";
}

TEST(DopplerLog, PingsKeepTheRateAndAreOlderThanTheirLine) {
  const Still motion;
  DopplerLog::Options options = exact();
  options.clock_ppm = 1000;
  RecordingLog log(options, motion);
  log.power_on(kStart_ns);
  testing::run_to(log, kStart_ns + 100 * kSecond_ns);
  EXPECT_EQ(log.pings.size(), 499U);
  EXPECT_EQ(log.sent_ns.at(7) - log.pings.at(7).measured_ns, 100'000'000);
  EXPECT_EQ(log.pings.at(7).number, 8U);
}

TEST(WaterLinkedDoppler, StatesValidityAndLock) {
  Still motion;
  motion.state.velocity_body_m_s = {1, 0, 0};
  auto options = exact();
  options.beam_noise_m_s = 1e-9;
  WaterLinkedDoppler log(options, motion);
  log.power_on(kStart_ns);
  const auto sent = testing::run_to(log, kStart_ns + kSecond_ns / 5);
  ASSERT_EQ(sent.size(), 1U);
  const auto line =
      std::string(sent[0].bytes.begin(), std::find(sent[0].bytes.begin(), sent[0].bytes.end(), '\n') + 1);
  const auto velocity = water_linked::decode_velocity(testing::bytes_of(line));
  ASSERT_TRUE(velocity);
  EXPECT_TRUE(velocity->valid);
  EXPECT_NEAR(velocity->velocity_m_s[0], 1, 1e-3);
  EXPECT_NEAR(velocity->altitude_m, 20, 0.01);
  EXPECT_EQ(*velocity->transmitted_at_us - *velocity->valid_at_us, 100'000);
  EXPECT_EQ(*velocity->transmitted_at_us, sent[0].start_ns / 1000);

  options.floor.depth_m = 100;
  WaterLinkedDoppler lost(options, motion);
  lost.power_on(kStart_ns);
  const std::string text = testing::text_of(testing::run_to(lost, kStart_ns + kSecond_ns / 5));
  EXPECT_EQ(text.substr(0, 30), "wrz,0.000,0.000,0.000,n,-1.00,") << text;
}

TEST(Pd0Doppler, SendsTheBottomsVelocityInTheAxesThatItNames) {
  Still motion;
  motion.state.velocity_body_m_s = {1, 0.25, 0.125};
  for (const auto axes : {pd0::Axes::beam, pd0::Axes::instrument, pd0::Axes::ship, pd0::Axes::earth}) {
    Pd0Doppler::Options options;
    static_cast<DopplerLog::Options&>(options) = exact();
    options.axes = axes;
    Pd0Doppler log(options, motion);
    log.power_on(kStart_ns);
    const auto ensemble = pd0::decode(testing::run_to(log, kStart_ns + kSecond_ns / 5).at(0).bytes);
    ASSERT_TRUE(ensemble.fixed && ensemble.variable && ensemble.bottom);
    EXPECT_EQ(ensemble.fixed->axes, axes);
    EXPECT_NEAR(ensemble.bottom->range_m[0].value(), 20, 0.011);
    if (axes == pd0::Axes::beam) {
      EXPECT_NEAR(ensemble.bottom->velocity_m_s[2].value(), 0.5 + 0.125 * std::sqrt(3) / 2, 1e-3);
    } else if (axes != pd0::Axes::earth) {
      EXPECT_NEAR(ensemble.bottom->velocity_m_s[0].value(), -0.25, 1e-3);
      EXPECT_NEAR(ensemble.bottom->velocity_m_s[1].value(), -1, 1e-3);
      EXPECT_NEAR(ensemble.bottom->velocity_m_s[2].value(), 0.125, 1e-3);
    }
  }
}

TEST(Pd6Doppler, SendsEachLineOfAPing) {
  Still motion;
  motion.state.velocity_body_m_s = {1, 0, 0};
  Pd6Doppler log(exact(), motion);
  log.power_on(kStart_ns);
  const std::string text = testing::text_of(testing::run_to(log, kStart_ns + kSecond_ns / 5));
  std::string names;
  for (std::size_t i = text.find(':'); i != std::string::npos; i = text.find(':', i + 1))
    names += text.substr(i + 1, 2);
  EXPECT_EQ(names, "SATSBIBSBEBD");
  EXPECT_NE(text.find(":BI,+00000,+01000,+00000,+00000,A\r\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace navcal::sim
