// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "protocols/nmea.h"
#include "protocols/oncore.h"

namespace navcal::protocols {

/// A receiver that may speak Motorola binary or NMEA 0183, and change from one to the other: both in one stream,
/// each byte in exactly one frame or in none.
struct GpsStreamScanner : StartsWith<'@', '$', '!'> {
  static constexpr std::size_t kMaxFrameLength = std::max(oncore::kMaxLength, nmea::kMaxLength);
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last) {
    return *first == '@' ? oncore::Scanner::scan(first, last) : nmea::Scanner::scan(first, last);
  }
};

using GpsStreamParser = StreamParser<GpsStreamScanner>;

}  // namespace navcal::protocols
