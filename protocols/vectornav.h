// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// VectorNav VN-100, VN-200, VN-300. Manual, not at hand (ICD): VN-100 user manual, "Binary output messages" and
/// "Asynchronous messages": FA, group byte, one field word (u16 LE) for each group, fields (LE), CRC-16/XMODEM
/// (BE) over all but the sync; beside it lines `$VN...*hh` (ICD section 12). No capture was at hand.
namespace navcal::protocols::vectornav {

inline constexpr FrameId kBinary{"VNBIN"};

/// Binary messages and lines. A message with a field whose size is not in the table (satellite lists) is not a
/// frame.
struct Scanner : StartsWith<0xFA, '$'> {
  static constexpr std::size_t kMaxFrameLength = 1024;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

using Triple = std::array<double, 3>;

/// What navcal reads of a binary message or a line. Body axes are x forward, y to starboard, z down as marked.
struct Reading {
  std::optional<std::uint64_t> since_startup_ns;  ///< the device's own clock
  std::optional<std::uint64_t> gps_time_ns;       ///< since 1980-01-06
  std::optional<Triple> yaw_pitch_roll_deg;
  std::optional<std::array<double, 4>> quaternion;  ///< scalar last
  std::optional<Triple> rate_rad_s;                 ///< compensated
  std::optional<Triple> position;                   ///< latitude, longitude in degrees, ellipsoid height in m
  std::optional<Triple> velocity_ned_m_s;
  std::optional<Triple> acceleration_m_s2;
  std::optional<Triple> raw_acceleration_m_s2, raw_rate_rad_s, raw_field_uT;  ///< uncompensated
  std::optional<Triple> field_uT;
  std::optional<double> temperature_C, pressure_Pa;  ///< inside the sensor
  std::optional<Triple> yaw_pitch_roll_std_deg;      ///< one standard deviation, as the sensor estimates it
  std::size_t unknown_fields = 0;                    ///< whose size is known and that are left
  bool operator==(const Reading&) const = default;
};
/// Fields of a binary message: of the common group, and the same quantities of the groups time, IMU and attitude;
/// nullopt for a line.
[[nodiscard]] std::optional<Reading> decode_binary(Bytes frame);
/// Binary message with the fields of the common group that are present, and the attitude's standard deviations of
/// the attitude group; the pairs of raw values, and field with temperature and pressure, are sent together.
[[nodiscard]] std::vector<std::uint8_t> encode_binary(const Reading& reading);

}  // namespace navcal::protocols::vectornav
