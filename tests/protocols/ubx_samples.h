// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/checked_line.h"
#include "protocols/ubx_configuration.h"
#include "protocols/ubx_navigation.h"
#include "tests/protocols/samples.h"

// Random messages of a u-blox receiver, whose values lie on the steps of the wire.
namespace navcal::protocols::test {

/// A multiple of `step` in [low, high] steps, as the decoder computes it.
inline double on_step(Random& random, std::int64_t low, std::int64_t high, double step) {
  return static_cast<double>(low +
                             static_cast<std::int64_t>(below(random, static_cast<std::size_t>(high - low + 1)))) *
         step;
}

/// Frame of an RTCM3 message of at most 1023 bytes. Its CRC-24Q bit by bit, unlike the decoder's.
inline Buffer encode_rtcm3(const Buffer& message) {
  Buffer frame{0xD3, static_cast<std::uint8_t>(message.size() >> 8), static_cast<std::uint8_t>(message.size())};
  frame.insert(frame.end(), message.begin(), message.end());
  std::uint32_t crc = 0;
  for (const std::uint8_t byte : frame) {
    crc ^= std::uint32_t{byte} << 16;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x800000U) != 0 ? (crc << 1 ^ 0x1864CFBU) : crc << 1;
  }
  for (const int shift : {16, 8, 0}) frame.push_back(static_cast<std::uint8_t>(crc >> shift));
  return frame;
}

inline ubx::NavPvt random_pvt(Random& random) {
  ubx::NavPvt pvt;
  pvt.time_of_week_ms = static_cast<std::uint32_t>(below(random, 604'800'000));
  pvt.date = {static_cast<std::uint16_t>(2010 + below(random, 40)),
              static_cast<std::uint8_t>(1 + below(random, 12)), static_cast<std::uint8_t>(1 + below(random, 28))};
  pvt.hour = static_cast<std::uint8_t>(below(random, 24));
  pvt.minute = static_cast<std::uint8_t>(below(random, 60));
  pvt.second = static_cast<std::uint8_t>(below(random, 60));
  pvt.nanosecond = static_cast<std::int32_t>(below(random, 2'000'000'000)) - 1'000'000'000;
  pvt.date_valid = chance(random);
  pvt.time_valid = chance(random);
  pvt.fully_resolved = chance(random);
  pvt.time_accuracy_s = on_step(random, 0, 4'000'000'000, 1e-9);
  pvt.fix_type = static_cast<std::uint8_t>(below(random, 6));
  pvt.fix_ok = chance(random);
  pvt.differential = chance(random);
  pvt.carrier_solution = static_cast<std::uint8_t>(below(random, 3));
  pvt.satellites = static_cast<std::uint8_t>(below(random, 40));
  pvt.longitude_deg = on_step(random, -1'800'000'000, 1'800'000'000, 1e-7);
  pvt.latitude_deg = on_step(random, -900'000'000, 900'000'000, 1e-7);
  pvt.height_m = on_step(random, -500'000, 9'000'000, 1e-3);
  pvt.height_msl_m = on_step(random, -500'000, 9'000'000, 1e-3);
  pvt.horizontal_accuracy_m = on_step(random, 0, 100'000, 1e-3);
  pvt.vertical_accuracy_m = on_step(random, 0, 100'000, 1e-3);
  for (double& one : pvt.velocity_ned_m_s) one = on_step(random, -50'000, 50'000, 1e-3);
  pvt.ground_speed_m_s = on_step(random, 0, 50'000, 1e-3);
  pvt.heading_of_motion_deg = on_step(random, 0, 35'999'999, 1e-5);
  pvt.speed_accuracy_m_s = on_step(random, 0, 10'000, 1e-3);
  pvt.heading_accuracy_deg = on_step(random, 0, 18'000'000, 1e-5);
  pvt.pdop = on_step(random, 0, 9999, 0.01);
  pvt.position_invalid = chance(random);
  return pvt;
}

inline ubx::NavSat random_sat(Random& random) {
  ubx::NavSat sat;
  sat.time_of_week_ms = static_cast<std::uint32_t>(random());
  sat.count = below(random, 60);
  for (std::size_t i = 0; i < sat.count; ++i) {
    const auto flags = static_cast<std::uint32_t>(random());
    sat.satellites[i] = {static_cast<std::uint8_t>(below(random, 7)),   static_cast<std::uint8_t>(random()),
                         static_cast<std::uint8_t>(below(random, 60)),  static_cast<std::int8_t>(random()),
                         static_cast<std::int16_t>(below(random, 361)), on_step(random, -30000, 30000, 0.1),
                         static_cast<std::uint8_t>(flags & 7U),         (flags & 8U) != 0,
                         static_cast<std::uint8_t>(flags >> 4 & 3U),    flags};
  }
  return sat;
}

inline Buffer random_ubx_frame(Random& random) {
  switch (below(random, 5)) {
    case 0: return ubx::encode_nav_sat(random_sat(random));
    case 1: return ubx::encode_acknowledgement({static_cast<ubx::MessageCode>(random()), chance(random)});
    case 2: {
      Buffer payload(below(random, 100));
      for (auto& byte : payload) byte = chance(random) ? std::uint8_t{0xB5} : static_cast<std::uint8_t>(random());
      return ubx::encode_frame(static_cast<ubx::MessageCode>(random()), payload);
    }
    default: return ubx::encode_nav_pvt(random_pvt(random));
  }
}

inline Buffer random_ubx_port_frame(Random& random) {
  switch (below(random, 4)) {
    case 0: return checked_line("GPVTG,,T,,M,0.0,N,0.0,K,A");
    case 1: return encode_rtcm3(Buffer(below(random, 200), 0xD3));
    default: return random_ubx_frame(random);
  }
}

template <>
inline Buffer random_frame<ubx::Scanner>(Random& random) {
  return random_ubx_frame(random);
}
template <>
inline Buffer random_frame<ubx::PortScanner>(Random& random) {
  return random_ubx_port_frame(random);
}

}  // namespace navcal::protocols::test
