// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "protocols/oncore.h"

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

}  // namespace navcal::protocols::oncore
