// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "protocols/checked_line.h"
#include "protocols/gps_stream.h"
#include "protocols/oncore_command.h"
#include "protocols/oncore_encode.h"
#include "tests/protocols/receiver_sentences.h"
#include "tests/protocols/samples.h"
#include "tests/protocols/stream.h"

// Random intact frames of satellite receivers.
namespace navcal::protocols::test {

/// A multiple of 1/steps in [-limit, limit].
inline double stepped(Random& random, int limit, int steps) {
  const auto range = static_cast<std::size_t>(2 * limit * steps + 1);
  return (static_cast<double>(below(random, range)) - limit * steps) / steps;
}

template <class Number>
Number any(Random& random) {
  return static_cast<Number>(random());
}

/// Within all ranges, at the resolution of the messages.
inline oncore::Position random_position(Random& random) {
  oncore::Position position;
  position.date = {static_cast<std::uint16_t>(1980 + below(random, 100)),
                   static_cast<std::uint8_t>(1 + below(random, 12)),
                   static_cast<std::uint8_t>(1 + below(random, 28))};
  position.time = {static_cast<std::uint8_t>(below(random, 24)), static_cast<std::uint8_t>(below(random, 60)),
                   static_cast<std::uint8_t>(below(random, 61)),
                   static_cast<std::uint32_t>(below(random, 1'000'000'000))};
  const auto place = [&] {
    return oncore::Coordinates{stepped(random, 90, 3'600'000), stepped(random, 180, 3'600'000),
                               stepped(random, 18000, 100), stepped(random, 18000, 100)};
  };
  position.filtered = place();
  position.unfiltered = place();
  position.speed_3d_m_s = static_cast<double>(below(random, 65536)) / 100;
  position.speed_m_s = static_cast<double>(below(random, 65536)) / 100;
  position.heading_deg = static_cast<double>(below(random, 3600)) / 10;
  position.dop = static_cast<double>(below(random, 1000)) / 10;
  position.visible = static_cast<std::uint8_t>(below(random, 14));
  position.tracked = static_cast<std::uint8_t>(below(random, 13));
  position.fix = static_cast<Fix>(below(random, 7));
  position.antenna = static_cast<oncore::Antenna>(below(random, 4));
  position.few_satellites = random() % 2 == 0;
  position.no_almanac = random() % 2 == 0;
  for (auto& channel : position.channels) {
    channel = {any<std::uint8_t>(random), static_cast<std::uint8_t>(below(random, 17)), any<std::uint8_t>(random),
               any<std::uint8_t>(random), any<std::uint16_t>(random)};
  }
  position.clock_bias_ns = any<std::int16_t>(random);
  position.oscillator_offset_Hz = any<std::uint32_t>(random);
  position.temperature_C = stepped(random, 60, 2);
  position.utc = oncore::UtcState{random() % 2 == 0, random() % 2 == 0,
                                  static_cast<std::int8_t>(static_cast<int>(below(random, 64)) - 32)};
  position.id_tag = std::array<char, 6>{'N', 'A', 'V', 'C', 'A', 'L'};
  return position;
}

inline oncore::VisibleSatellites random_sky(Random& random) {
  oncore::VisibleSatellites sky;
  sky.visible = static_cast<std::uint8_t>(below(random, 14));
  sky.count = std::min<std::size_t>(sky.visible, oncore::VisibleSatellites::kSlots);
  for (std::size_t i = 0; i < sky.count; ++i) {
    sky.satellites[i] = {any<std::uint8_t>(random), any<std::int16_t>(random),
                         static_cast<std::uint8_t>(below(random, 91)),
                         static_cast<std::uint16_t>(below(random, 361)), any<std::uint8_t>(random)};
  }
  sky.in_range = true;
  return sky;
}

inline nmea::Navigation random_navigation(Random& random) {
  nmea::Navigation navigation;
  navigation.date = {static_cast<std::uint16_t>(1980 + below(random, 100)),
                     static_cast<std::uint8_t>(1 + below(random, 12)),
                     static_cast<std::uint8_t>(1 + below(random, 28))};
  navigation.time = {static_cast<std::uint8_t>(below(random, 24)), static_cast<std::uint8_t>(below(random, 60)),
                     static_cast<std::uint8_t>(below(random, 61)),
                     static_cast<std::uint32_t>(below(random, 100)) * 10'000'000};
  navigation.fix = std::array{Fix::none, Fix::fix_2d, Fix::fix_3d, Fix::propagated}[below(random, 4)];
  navigation.latitude_deg = stepped(random, 90, 600'000);
  navigation.longitude_deg = stepped(random, 180, 600'000);
  navigation.altitude_m = stepped(random, 18000, 10);
  navigation.geoid_separation_m = stepped(random, 100, 10);
  navigation.speed_m_s = static_cast<double>(below(random, 100000)) / 1000;
  navigation.course_deg = static_cast<double>(below(random, 3600)) / 10;
  navigation.pdop = static_cast<double>(below(random, 999)) / 10;
  navigation.hdop = static_cast<double>(below(random, 999)) / 10;
  navigation.vdop = static_cast<double>(below(random, 999)) / 10;
  return navigation;
}

inline nmea::Satellites random_satellites(Random& random) {
  nmea::Satellites satellites(below(random, 13));
  for (auto& satellite : satellites) {
    satellite = {static_cast<std::uint8_t>(1 + below(random, 99)), static_cast<std::uint8_t>(below(random, 91)),
                 static_cast<std::uint16_t>(below(random, 360)), std::nullopt, random() % 2 == 0};
    if (random() % 2 == 0) satellite.cn0_dBHz = static_cast<std::uint8_t>(below(random, 60));
  }
  return satellites;
}

/// The text of an Eq: three digits of checksum behind the last comma.
inline Buffer ascii_position(const std::string& fields) {
  const std::string body = "Eq," + fields + ",";
  Buffer frame{'@', '@'};
  append(frame, Bytes(reinterpret_cast<const std::uint8_t*>(body.data()), body.size()));
  const unsigned sum = xor_of(Bytes(frame).subspan(2));
  for (const unsigned digit : {sum / 100, sum / 10 % 10, sum % 10})
    frame.push_back(static_cast<std::uint8_t>('0' + digit));
  frame.insert(frame.end(), {'\r', '\n'});
  return frame;
}

inline const std::string kAsciiPosition =
    "11,21,26,12,34,56,37,12.3450,N,080,24.0600,W,+00540.5,002.5,123.4,0,2,01.8,07,0000,00";

inline Buffer random_oncore_frame(Random& random) {
  switch (below(random, 7)) {
    case 0: return oncore::encode_ha(random_position(random));
    case 1: return oncore::encode_ea(random_position(random));
    case 2: return oncore::encode_bb(random_sky(random));
    case 3: return oncore::encode_bo({std::int8_t{18}});
    case 4: return oncore::encode_cj("MODEL #    P283T12NR1\r\nSERIAL #   P047LB\r\n@@Ha\r\n");
    case 5: return ascii_position(kAsciiPosition);
    default: {  // Gj with any content: CR LF and @@ inside happen
      Buffer data(14);
      for (auto& byte : data) byte = std::array<std::uint8_t, 4>{'@', '\r', '\n', 'E'}[below(random, 4)];
      return oncore::encode_frame(oncore::kGj, data);
    }
  }
}

inline Buffer random_sentence(Random& random) {
  const auto navigation = random_navigation(random);
  switch (below(random, 7)) {
    case 0: return nmea::encode_gga(navigation, random_satellites(random));
    case 1: return nmea::encode_rmc(navigation);
    case 2: return nmea::encode_vtg(navigation);
    case 3: return nmea::encode_zda(navigation);
    case 4: return checked_line("PTNTHTM,14223,N,169,N,-43,N,13641,2454");
    case 5: return checked_line("HCHDM,182.3,M");
    default: return nmea::encode_gsa(navigation, random_satellites(random));
  }
}

inline Buffer random_poll(Random& random) {
  const std::array ids{oncore::kHa, oncore::kHb, oncore::kEa, oncore::kBa, oncore::kBb,
                       oncore::kBo, oncore::kHn, oncore::kEq, oncore::kCj, oncore::kGj};
  return oncore::encode_poll(ids[below(random, ids.size())], any<std::uint8_t>(random));
}

template <>
inline Buffer random_frame<oncore::Scanner>(Random& random) {
  return random_oncore_frame(random);
}

template <>
inline Buffer random_frame<oncore::CommandScanner>(Random& random) {
  return random_poll(random);
}

template <>
inline Buffer random_frame<nmea::Scanner>(Random& random) {
  return random_sentence(random);
}

template <>
inline Buffer random_frame<GpsStreamScanner>(Random& random) {
  return chance(random) ? random_oncore_frame(random) : random_sentence(random);
}

}  // namespace navcal::protocols::test
