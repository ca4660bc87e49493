// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// Water Linked DVL A50 and A125, serial protocol 2.3: lines `wr<letter>,field,...*hh<LF>`, CR before LF allowed,
/// CRC-8 in lower case over all before `*`. The network port sends one JSON object a line instead. Source: "Water
/// Linked DVL protocol" (ICD section 10).
namespace navcal::protocols::water_linked {

inline constexpr FrameId kVelocity{"wrz"}, kVelocityOld{"wrx"}, kTransducer{"wru"}, kPosition{"wrp"},
    kVelocityJson{"velocity"}, kPositionJson{"position_local"};

/// Lines from the instrument. The identifier is `wr` and the letter, or the type of the object.
struct Scanner : StartsWith<'w', '{'> {
  static constexpr std::size_t kMaxFrameLength = 2048;  ///< of a velocity in JSON, twice its usual length
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

/// wrz, wrx or JSON. Axes are those of the mounted instrument: x forward, y to starboard, z down.
struct Velocity {
  std::array<double, 3> velocity_m_s{};
  bool valid = false;  ///< bottom lock; without it nothing else is to be used
  double altitude_m = 0;
  double figure_of_merit_m_s = 0;
  std::optional<std::array<double, 9>> covariance_m2_s2;       ///< row by row; not wrx
  std::optional<std::int64_t> valid_at_us, transmitted_at_us;  ///< clock of the instrument, UNIX time; not wrx
  double since_last_ms = 0;                                    ///< since the velocity before
  std::uint32_t status = 0;                                    ///< 0; 1: too warm
  bool operator==(const Velocity&) const = default;
};
[[nodiscard]] std::optional<Velocity> decode_velocity(Bytes frame);
/// wrz. Velocities with three decimals, altitude with two.
[[nodiscard]] std::vector<std::uint8_t> encode(const Velocity& velocity);

/// wru: one beam.
struct Transducer {
  std::uint8_t number = 0;
  double velocity_m_s = 0;  ///< along the beam
  double distance_m = 0;    ///< negative: none
  double signal_dBm = 0, noise_dBm = 0;
  bool operator==(const Transducer&) const = default;
};
[[nodiscard]] std::optional<Transducer> decode_transducer(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode(const Transducer& transducer);

/// wrp or JSON: dead reckoning of the instrument itself, in its own local frame (north, east, down from the
/// reset).
struct Position {
  double time_s = 0;
  std::array<double, 3> position_m{};
  double std_m = 0;
  double roll_deg = 0, pitch_deg = 0, yaw_deg = 0;
  std::uint32_t status = 0;
  bool operator==(const Position&) const = default;
};
[[nodiscard]] std::optional<Position> decode_position(Bytes frame);

/// Any line, with its checksum and CR LF: answers, and commands as `wcs,1500,,,`.
[[nodiscard]] std::vector<std::uint8_t> encode_line(std::string_view body);

}  // namespace navcal::protocols::water_linked
