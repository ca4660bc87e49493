// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/oncore.h"

/// Commands of a host to an Oncore.
namespace navcal::protocols::oncore {

/// Sets everything to its defaults: nothing is sent unasked, and almanac, ephemerides, time and position are
/// cleared. The receiver answers with the same frame.
inline constexpr FrameId kCf{"Cf"};

/// The command that asks for a message. `rate` 0: once, n: every n seconds. Cf, Cj and Gj are only ever sent once
/// and take no rate byte (ICD section 2).
[[nodiscard]] std::vector<std::uint8_t> encode_poll(FrameId id, std::uint8_t rate);

/// Request of a host.
struct Command {
  FrameId id;
  std::optional<std::uint8_t> rate;  ///< nullopt for those without a rate byte
};

/// One whole command with its framing; nullopt when it is malformed or not a poll of a message known here. A
/// receiver drops such input without a word.
[[nodiscard]] std::optional<Command> parse_command(Bytes frame);

/// Commands of a host, for the emulated receiver: polls, and what parse_aid_position() and parse_aid_time() take.
struct CommandScanner {
  static constexpr std::size_t kMaxFrameLength = 20;

  static const std::uint8_t* find_start(const std::uint8_t* first, const std::uint8_t* last) {
    return Scanner::find_start(first, last);
  }
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};

using CommandParser = StreamParser<CommandScanner>;

// Position and time that a host gives a 12-channel Oncore: the commands @@Ga and @@Gb (Motorola M12+ user's guide,
// revision 6, chapter 5). A receiver that knows the almanac is then in the state of a warm start. It ignores the
// time while it tracks a satellite.

inline constexpr FrameId kGa{"Ga"};  ///< combined position
inline constexpr FrameId kGb{"Gb"};  ///< combined time
inline constexpr std::size_t kGaLength = 20, kGbLength = 17;

struct AidPosition {
  double latitude_deg = 0, longitude_deg = 0;  ///< WGS84
  double height_m = 0;                         ///< above the ellipsoid
};

/// Values beyond the ranges of the command are clamped to them.
[[nodiscard]] std::vector<std::uint8_t> encode_aid_position(const AidPosition& position);
/// UTC, nanoseconds since 1970, rounded down to the second; the offset of local time is 0.
[[nodiscard]] std::vector<std::uint8_t> encode_aid_time(std::int64_t utc_ns);

/// Nullopt when the frame is no intact command of this kind, a query, or out of range.
[[nodiscard]] std::optional<AidPosition> parse_aid_position(Bytes frame);
/// UTC, nanoseconds since 1970. Nullopt likewise, and when a local time is stated.
[[nodiscard]] std::optional<std::int64_t> parse_aid_time(Bytes frame);

}  // namespace navcal::protocols::oncore
