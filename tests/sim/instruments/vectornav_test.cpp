// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/vectornav.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

namespace vn = protocols::vectornav;

struct EmulatedVectorNav : ::testing::Test {
  Still motion;
  std::int64_t t_ns = kStart_ns;
  VectorNav::Options options;
  std::unique_ptr<VectorNav> sensor;

  void power() {
    sensor = std::make_unique<VectorNav>(options, motion);
    sensor->power_on(t_ns);
  }
  std::vector<Emission> run(double seconds) {
    t_ns += static_cast<std::int64_t>(seconds * 1e9);
    return run_to(*sensor, t_ns);
  }
  /// Hands over a command; the sensor's answer as text.
  std::string tell(unsigned number, const std::string& values) {
    sensor->on_bytes(t_ns, vn::encode_register({true, number, values}));
    for (const Emission& emission : run(0.024)) {
      const std::string text(emission.bytes.begin(), emission.bytes.end());
      if (text.starts_with("$VNWRG") || text.starts_with("$VNERR")) return text.substr(1, text.find('*') - 1);
    }
    return {};
  }
  static std::vector<vn::Reading> readings(const std::vector<Emission>& emissions) {
    std::vector<vn::Reading> found;
    for (const Emission& emission : emissions) {
      if (const auto reading = vn::decode_binary(emission.bytes)) found.push_back(*reading);
    }
    return found;
  }
};

TEST_F(EmulatedVectorNav, SendsLinesAsDelivered) {
  power();
  const auto lines = run(1);
  EXPECT_NEAR(static_cast<double>(lines.size()), 40, 1);
  for (const Emission& line : lines) EXPECT_TRUE(vn::decode_line(line.bytes));
}

TEST_F(EmulatedVectorNav, ObeysItsRegisters) {
  power();
  EXPECT_EQ(tell(vn::kAsyncType, "0"), "VNWRG,06,0");
  EXPECT_TRUE(run(1).empty());
  EXPECT_EQ(tell(vn::kBinaryOutput1, "1,8,11,0529,0100"), "VNWRG,75,1,8,11,0529,0100");
  EXPECT_NEAR(static_cast<double>(readings(run(1)).size()), 100, 1);
  EXPECT_EQ(tell(vn::kBinaryOutput1, "2,8,01,0529"), "VNWRG,75,2,8,01,0529");
  EXPECT_TRUE(run(1).empty()) << "its other port";
  EXPECT_EQ(tell(vn::kAsyncRate, "50"), "VNWRG,07,50");
  EXPECT_EQ(tell(vn::kAsyncType, "14"), "VNWRG,06,14");
  EXPECT_NEAR(static_cast<double>(run(1).size()), 50, 1);
  sensor->power_on(t_ns);
  EXPECT_NEAR(static_cast<double>(run(1).size()), 40, 1) << "power takes the settings";
}

TEST_F(EmulatedVectorNav, RefusesWhatItCannot) {
  options.has_errors = false;
  power();
  EXPECT_EQ(tell(vn::kBinaryOutput1, "1,20,11,0529,0100"), "VNERR,07");
  EXPECT_EQ(tell(vn::kBinaryOutput1, "1,20"), "VNERR,07");
  EXPECT_EQ(tell(vn::kBinaryOutput1, "1,1,01,0529"), "VNERR,0C") << "800 Hz at 115200 baud";
  EXPECT_EQ(tell(vn::kAsyncRate, "30"), "VNERR,07");
  EXPECT_EQ(tell(99, "1"), "VNERR,08");
}

TEST_F(EmulatedVectorNav, ItsValuesAreThoseOfTheVehicleWithTheErrorsThatItStates) {
  motion.state.euler_rad = {0.1, -0.2, 2};
  motion.state.rate_rad_s = {0.01, 0.02, -0.3};
  power();
  tell(vn::kAsyncType, "0");
  tell(vn::kBinaryOutput1, "1,20,11,0529,0100");
  const auto all = readings(run(50));
  ASSERT_GT(all.size(), 1900U);
  const Vector3& field = motion.state.field_world_uT;
  const double magnetic_rad = 2 - std::atan2(field[1], field[0]);
  constexpr double kDegree = std::numbers::pi / 180;
  double heading_sum = 0, rate_sum = 0, field_sum = 0;
  for (const vn::Reading& reading : all) {
    const double error_rad = (*reading.yaw_pitch_roll_deg)[0] * kDegree - magnetic_rad;
    heading_sum += error_rad * error_rad;
    rate_sum += (*reading.rate_rad_s)[2];
    field_sum += std::hypot((*reading.field_uT)[0], (*reading.field_uT)[1], (*reading.field_uT)[2]);
    EXPECT_NEAR((*reading.yaw_pitch_roll_deg)[1] * kDegree, -0.2, 0.03);
    EXPECT_NEAR((*reading.yaw_pitch_roll_deg)[2] * kDegree, 0.1, 0.03);
    EXPECT_NEAR((*reading.acceleration_m_s2)[2], -kGravity_m_s2, 0.1);
  }
  const auto n = static_cast<double>(all.size());
  EXPECT_NEAR(std::sqrt(heading_sum / n) / ((*all[0].yaw_pitch_roll_std_deg)[0] * kDegree), 1, 0.1);
  EXPECT_NEAR(rate_sum / n, -0.3, 1e-3);
  EXPECT_NEAR(field_sum / n, std::hypot(field[0], field[1], field[2]), 0.1);
}

TEST_F(EmulatedVectorNav, ItsTimeIsThatOfItsOwnClock) {
  options.clock_ppm = 100;
  power();
  tell(vn::kAsyncType, "0");
  tell(vn::kBinaryOutput1, "1,20,01,0529");
  const auto emissions = run(100);
  const auto all = readings(emissions);
  ASSERT_GT(all.size(), 3900U);
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(*all[i].since_startup_ns - *all[i - 1].since_startup_ns), 25e6, 10);
  }
  EXPECT_NEAR(static_cast<double>(emissions.back().start_ns - emissions.front().start_ns),
              static_cast<double>(all.size() - 1) * 25e6 * (1 + 100e-6), 1e4);
}

}  // namespace
}  // namespace navcal::sim::testing
