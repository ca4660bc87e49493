// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

namespace navcal::protocols::oncore {

inline constexpr FrameId kHa{"Ha"};  ///< position, status, data: 12 channels
inline constexpr FrameId kHb{"Hb"};  ///< the same, short
inline constexpr FrameId kEa{"Ea"};  ///< position, status, data: 8 channels
inline constexpr FrameId kBa{"Ba"};  ///< position, status, data: 6 channels
inline constexpr FrameId kBb{"Bb"};  ///< visible satellites
inline constexpr FrameId kBo{"Bo"};  ///< offset of UTC from GPS time
inline constexpr FrameId kGj{"Gj"};  ///< leap second announcement
inline constexpr FrameId kHn{"Hn"};  ///< time RAIM
inline constexpr FrameId kCj{"Cj"};  ///< identification
inline constexpr FrameId kEq{"Eq"};  ///< position in ASCII

inline constexpr std::size_t kMaxLength = 294;  ///< of Cj, the longest

/// Total length of the response with these two letters, framing included; 0 when no such response is known
/// (ICD section 2; Ci has none).
[[nodiscard]] std::size_t response_length(std::uint8_t first, std::uint8_t second);

/// Frames of the receiver: @@, two letters, data, checksum, CR LF; the length follows from the letters.
struct Scanner : StartsWith<'@'> {
  static constexpr std::size_t kMaxFrameLength = kMaxLength;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};

using Parser = StreamParser<Scanner>;

}  // namespace navcal::protocols::oncore
