// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/vectornav_lines.h"
#include "tests/protocols/mip_samples.h"

// Random messages of a VectorNav sensor.
namespace navcal::protocols::test {

inline vectornav::Reading random_vectornav_reading(Random& random) {
  vectornav::Reading reading;
  reading.since_startup_ns = perhaps(random, static_cast<std::uint64_t>(random()));
  reading.gps_time_ns = perhaps(random, static_cast<std::uint64_t>(random()));
  reading.yaw_pitch_roll_deg = perhaps_triple(random, 1);
  reading.rate_rad_s = perhaps_triple(random, 1);
  reading.position = perhaps_triple(random, 1.25);
  reading.velocity_ned_m_s = perhaps_triple(random, 1);
  reading.acceleration_m_s2 = perhaps_triple(random, 1);
  if (chance(random)) reading.quaternion = {random_float(random, 1), random_float(random, 1), 0, 1};
  reading.yaw_pitch_roll_std_deg = perhaps_triple(random, 1);
  if (chance(random)) {
    reading.raw_acceleration_m_s2 = vectornav::Triple{random_float(random, 9), 1, 2};
    reading.raw_rate_rad_s = vectornav::Triple{random_float(random, 9), 1, 2};
  }
  if (chance(random)) {
    reading.field_uT = vectornav::Triple{random_float(random, 0.5) * 100, 0, random_float(random, 0.5) * 100};
    reading.temperature_C = random_float(random, 40);
    reading.pressure_Pa = random_float(random, 110) * 1000;
  }
  return reading;
}

template <>
inline Buffer random_frame<vectornav::Scanner>(Random& random) {
  const vectornav::Reading reading = random_vectornav_reading(random);
  return chance(random) ? vectornav::encode_binary(reading) : vectornav::encode_line(reading);
}

}  // namespace navcal::protocols::test
