// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace navcal::sim {

/// A sky that does not move, but is enough for every message that lists satellites.
struct SkySatellite {
  std::uint8_t prn;
  std::uint8_t elevation_deg;
  std::uint16_t azimuth_deg;
  std::uint8_t cn0_dBHz;
  bool used;
};

inline constexpr std::array<SkySatellite, 8> kSky{{{2, 61, 48, 47, true},
                                                   {5, 34, 301, 43, true},
                                                   {7, 22, 118, 40, true},
                                                   {13, 75, 215, 49, true},
                                                   {15, 48, 171, 45, true},
                                                   {20, 16, 76, 37, true},
                                                   {29, 27, 259, 41, true},
                                                   {30, 6, 332, 31, false}}};
inline constexpr std::uint8_t kSkyUsed = 7;
inline constexpr std::uint8_t kSkyUsedFlat = 3;  ///< of a two-dimensional fix
inline constexpr double kSkyPdop = 1.9, kSkyHdop = 1.1, kSkyVdop = 1.5;

}  // namespace navcal::sim
