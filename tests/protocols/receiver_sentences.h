// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "protocols/gps_fix.h"
#include "protocols/utc.h"

namespace navcal::protocols::nmea {

/// State of a receiver. These sentences are written apart from those of navcal, which the decoder would find right
/// by the same mistake.
struct Navigation {
  Date date;
  TimeOfDay time;  ///< sent with hundredths of a second
  Fix fix = Fix::none;
  double latitude_deg = 0, longitude_deg = 0;  ///< sent with 1e-4 minutes, 0.2 m
  double altitude_m = 0, geoid_separation_m = 0;
  double speed_m_s = 0;
  double course_deg = 0;
  double pdop = 0, hdop = 0, vdop = 0;
};

struct SatelliteInView {
  std::uint8_t number = 0;
  std::uint8_t elevation_deg = 0;
  std::uint16_t azimuth_deg = 0;
  std::optional<std::uint8_t> cn0_dBHz;
  bool used = false;
};

using Satellites = std::vector<SatelliteInView>;

// Sentences as GPS receivers send them, talker GP, with checksum and CR LF. Without a fix what depends on it is
// empty.
[[nodiscard]] std::vector<std::uint8_t> encode_gga(const Navigation& navigation, const Satellites& satellites);
[[nodiscard]] std::vector<std::uint8_t> encode_rmc(const Navigation& navigation);
[[nodiscard]] std::vector<std::uint8_t> encode_vtg(const Navigation& navigation);
[[nodiscard]] std::vector<std::uint8_t> encode_gsa(const Navigation& navigation, const Satellites& satellites);
[[nodiscard]] std::vector<std::uint8_t> encode_zda(const Navigation& navigation);
/// Satellites in view in the necessary number of sentences, four satellites in each.
[[nodiscard]] std::vector<std::uint8_t> encode_gsv(const Satellites& satellites);

}  // namespace navcal::protocols::nmea
