// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// Samples that another program sends: one JSON object a line (ICD section 13). The lines have no checksum: they
/// come from a program, not over a noisy wire.
namespace navcal::protocols::samples_line {

inline constexpr FrameId kSample{"SAMPLE"};
inline constexpr std::size_t kMaxLength = 2048;  ///< with the line feed

struct Scanner {
  static constexpr std::size_t kMaxFrameLength = kMaxLength;

  static const std::uint8_t* find_start(const std::uint8_t* first, const std::uint8_t* last) {
    return std::find(first, last, std::uint8_t{'{'});
  }
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

}  // namespace navcal::protocols::samples_line
