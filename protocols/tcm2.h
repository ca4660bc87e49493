// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"
#include "protocols/tcm2_reply.h"
#include "protocols/tcm2_word.h"

/// PNI TCM2 compass, device to host (ICD section 1). What the host sends is in tcm2_commands.h.
namespace navcal::protocols::tcm2 {

inline constexpr FrameId kWord{"WORD"};    ///< a data word, `$C328.3...*hh`: decode_word()
inline constexpr FrameId kHchdm{"HCHDM"};  ///< the heading as NMEA (`sdo=n`): decode_hchdm()
inline constexpr FrameId kReply{"REPLY"};  ///< `:` and what may follow it, or a calibration score: decode_reply()
inline constexpr FrameId kBanner{"BANNER"};  ///< a line that begins with TCM2: the device has started

/// Words and replies interleave, so one scanner knows them all. Any other `$` line is not a frame.
struct Scanner {
  /// The longest word that makes sense (all fields, mils, `-9999.99` uT, stray colon, four-digit code) has 74
  /// bytes and a banner is a line of a terminal; 128 bytes are 133 ms at 9600 baud, so that a cut line does not
  /// hold for long.
  static constexpr std::size_t kMaxFrameLength = 128;

  static const std::uint8_t* find_start(const std::uint8_t* first, const std::uint8_t* last) {
    while (first != last && !kStarts[*first]) ++first;
    return first;
  }
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);

 private:
  static constexpr auto kStarts = [] {
    std::array<bool, 256> table{};
    for (const char c : {'$', ':', 'H', 'T'}) table[static_cast<std::uint8_t>(c)] = true;
    return table;
  }();
};
using Parser = StreamParser<Scanner>;

}  // namespace navcal::protocols::tcm2
