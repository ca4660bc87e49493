// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/tcm2_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "protocols/tcm2_word.h"
#include "sim/instruments/tcm2.h"
#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

Tcm2Sensor::Options quiet() {
  Tcm2Sensor::Options options;
  options.field_noise_uT = options.tilt_noise_deg = options.temperature_noise_C = 0;
  return options;
}

TEST(Tcm2Sensor, HeadingIsThatFromMagneticNorthWhateverTheTilt) {
  Still motion;
  const double declination = std::atan2(0.6, 19.0);
  for (const double yaw : {0.0, 1.0, 2.5, 4.0, 6.2}) {
    for (const double tilt : {-0.4, 0.0, 0.3}) {
      motion.state.euler_rad = {tilt, -tilt / 2, yaw};
      Tcm2Sensor sensor(quiet(), motion, 1);
      sensor.power_on(kStart_ns);
      const double heading = sensor.measure(kStart_ns + kSecond_ns).heading_rad;
      EXPECT_NEAR(std::remainder(heading - (yaw - declination), 2 * std::numbers::pi), 0, 1e-9)
          << yaw << ' ' << tilt;
      EXPECT_GE(heading, 0);
      EXPECT_LT(heading, 2 * std::numbers::pi);
    }
  }
}

TEST(Tcm2Sensor, TheFluidFollowsAStepWithItsTimeConstant) {
  Still motion;
  Tcm2Sensor sensor(quiet(), motion, 1);
  sensor.power_on(kStart_ns);
  motion.state.euler_rad = {0.2, 0.1, 0};
  const Tcm2Reading reading = sensor.measure(kStart_ns + 300'000'000);
  // The motion is seen every 10 ms and taken for straight between: the step for a ramp, 5 ms late in the mean.
  const double followed = 1 - std::exp(-(0.3 - 0.005) / 0.3);
  EXPECT_NEAR(reading.roll_rad, 0.2 * followed, 2e-5);
  EXPECT_NEAR(reading.pitch_rad, 0.1 * followed, 1e-5);
  EXPECT_NEAR(sensor.measure(kStart_ns + 6 * kSecond_ns).roll_rad, 0.2, 1e-6);
}

TEST(Tcm2Sensor, WarmsUpAboveTheWater) {
  const Still motion;
  Tcm2Sensor sensor(quiet(), motion, 1);
  sensor.power_on(kStart_ns);
  EXPECT_NEAR(sensor.measure(kStart_ns).temperature_C, 15, 1e-9);
  EXPECT_NEAR(sensor.measure(kStart_ns + 200 * kSecond_ns).temperature_C, 15 + 8 * (1 - std::exp(-1)), 1e-3);
}

TEST(Tcm2Sensor, UnitsAndTheTurnsEnd) {
  Still motion;
  motion.state.field_world_uT = {19, 0, 44};
  motion.state.euler_rad = {0, 10 * base::kRadiansPerDegree, -0.02 * base::kRadiansPerDegree};  // 359.98 degrees
  Tcm2::Options options;
  options.sensor = quiet();
  Tcm2 compass(options, motion);
  compass.power_on(kStart_ns);
  std::int64_t t_ns = kStart_ns + kSecond_ns;
  run_to(compass, t_ns);
  const auto word = [&] {
    const std::string text = say(compass, t_ns, "s?\r", 0.2);
    return protocols::tcm2::decode_word(bytes_of(text)).value_or(protocols::tcm2::Word{});
  };
  EXPECT_EQ(word().heading, 0.0) << "360.0 is not said";
  EXPECT_EQ(word().pitch, 10.0);
  EXPECT_FALSE(word().error);
  say(compass, t_ns, "uc=m\rui=m\rut=f\r");
  EXPECT_EQ(word().heading, 0.0);
  EXPECT_EQ(word().pitch, 178.0);
  EXPECT_NEAR(*word().temperature, 59, 0.3);
  motion.state.euler_rad[0] = 60 * base::kRadiansPerDegree;
  t_ns += 5 * kSecond_ns;
  EXPECT_EQ(word().error, protocols::tcm2::error::kInclinometerOutOfRange);
}

}  // namespace
}  // namespace navcal::sim::testing
