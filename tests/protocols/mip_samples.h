// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/mip.h"
#include "tests/protocols/samples.h"

// Random packets of an inertial sensor.
namespace navcal::protocols::test {

inline double random_float(Random& random, double limit) {
  return static_cast<double>(
      static_cast<float>(limit * (static_cast<double>(below(random, 2'000'001)) / 1e6 - 1)));
}

inline std::optional<mip::Triple> perhaps_triple(Random& random, double unit) {
  if (chance(random)) return std::nullopt;
  return mip::Triple{random_float(random, 9) * unit, random_float(random, 9) * unit,
                     random_float(random, 9) * unit};
}

inline mip::Packet random_mip_packet(Random& random) {
  mip::Packet packet;
  packet.set = chance(random) ? mip::kSensorSet : mip::kFilterSet;
  packet.reference_time_ns = perhaps(random, static_cast<std::uint64_t>(random()));
  packet.reference_delta_ns = perhaps(random, static_cast<std::uint64_t>(random()));
  packet.delta_time_s = perhaps(random, random_float(random, 2));
  packet.gps_time = perhaps(random, mip::GpsTime{random_float(random, 6e5), 2300, chance(random), chance(random)});
  if (packet.set == mip::kSensorSet) {
    packet.acceleration_m_s2 = perhaps_triple(random, 9.80665);
    packet.rate_rad_s = perhaps_triple(random, 1);
    packet.field_uT = perhaps_triple(random, 100);
    packet.delta_theta_rad = perhaps_triple(random, 1);
    packet.delta_velocity_m_s = perhaps_triple(random, 9.80665);
    packet.euler_rad = perhaps_triple(random, 1);
    packet.pressure_Pa = perhaps(random, random_float(random, 1000) * 100);
  } else {
    packet.filter_position = perhaps_triple(random, 1.25);
    packet.filter_velocity_ned_m_s = perhaps_triple(random, 1);
    packet.filter_euler_rad = perhaps_triple(random, 1);
    packet.filter_euler_std_rad = perhaps_triple(random, 1);
    packet.filter_gyro_bias_rad_s = perhaps_triple(random, 1);
    packet.filter_rate_rad_s = perhaps_triple(random, 1);
    packet.filter_state = perhaps(random, static_cast<std::uint16_t>(below(random, 5)));
  }
  return packet;
}

template <>
inline Buffer random_frame<mip::Scanner>(Random& random) {
  if (below(random, 4) > 0) return mip::encode(random_mip_packet(random));
  return mip::encode_fields(static_cast<std::uint8_t>(random()),
                            {{static_cast<std::uint8_t>(random()), Buffer(below(random, 100), 0x75)}});
}

}  // namespace navcal::protocols::test
