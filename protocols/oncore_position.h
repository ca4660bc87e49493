// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "protocols/frame.h"
#include "protocols/gps_fix.h"
#include "protocols/utc.h"

namespace navcal::protocols::oncore {

enum class Antenna : std::uint8_t { ok, shorted, open, unknown };

/// One receiver channel of Ha, Ea or Ba.
struct Channel {
  std::uint8_t satellite = 0;  ///< PRN; 0: idle
  std::uint8_t mode = 0;       ///< 8: the satellite is used for the position
  std::uint8_t cn0 = 0;        ///< signal strength, dB-Hz (Ha) or 0-255 (Ea, Ba)
  std::optional<std::uint8_t> iode;
  std::uint16_t status = 0;
};

struct Coordinates {
  double latitude_deg = 0;             ///< WGS84, north positive
  double longitude_deg = 0;            ///< east positive
  double height_m = 0;                 ///< above the ellipsoid
  std::optional<double> height_msl_m;  ///< above mean sea level; 0 on many receivers
};

/// Offset of UTC as Ha tells it.
struct UtcState {
  bool enabled = false;  ///< times are UTC, else GPS time
  bool decoded = false;  ///< the offset is known; until then times are GPS time, whatever was asked for
  std::int8_t offset_s = 0;
};

/// Position, status and data of Ha, Hb, Ea, Ba and Eq (ICD section 2). What a message does not carry is nullopt.
struct Position {
  /// All values within the ranges of ICD section 2 and the date one of the calendar. An intact frame that is not
  /// in range is a receiver without a clue, or two bit errors: use nothing of it.
  bool in_range = false;

  Date date;  ///< as sent: see correct_rollover()
  TimeOfDay time;
  Coordinates filtered;
  std::optional<Coordinates> unfiltered;
  std::optional<double> speed_3d_m_s;
  double speed_m_s = 0;    ///< over ground; noise (to 0.2 m/s) at rest, 0 in position hold
  double heading_deg = 0;  ///< over ground, clockwise from true north; noise at rest, 0 in position hold
  double dop = 0;          ///< PDOP when 3D, HDOP when 2D, 0 otherwise
  std::optional<std::uint8_t> visible;  ///< can exceed the number of channels and of slots in Bb
  std::uint8_t tracked = 0;
  Fix fix = Fix::none;
  std::optional<std::uint16_t> status;  ///< receiver status as sent
  std::optional<Antenna> antenna;
  bool few_satellites = false;  ///< fewer than three visible
  bool no_almanac = false;      ///< cold start, or almanac out of date
  std::array<Channel, 12> channels{};
  std::size_t channel_count = 0;
  std::optional<std::int16_t> clock_bias_ns;
  std::optional<std::uint32_t> oscillator_offset_Hz;
  std::optional<double> temperature_C;
  std::optional<UtcState> utc;
  std::optional<std::array<char, 6>> id_tag;
};

/// nullopt when the frame is none of Ha, Hb, Ea, Ba, Eq, or an Eq whose text cannot be read.
[[nodiscard]] std::optional<Position> decode_position(Bytes frame);

}  // namespace navcal::protocols::oncore
