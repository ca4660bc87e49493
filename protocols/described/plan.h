// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "protocols/described/description.h"

namespace navcal::protocols::described {

/// One kind of frame, ready to be found; without its fields.
struct KindPlan : FrameKind {
  KindPlan() = default;
  KindPlan(const FrameKind& kind, bool text);

  std::size_t least = 0, longest = kMaxFrameLength;
  std::size_t sum_size = 0;
  bool is_text = false;
  bool is_nmea = false;          ///< the line of protocols/checked_line.h
  bool starts_anywhere = false;  ///< no start characters: a line begins behind the end of another
  bool start_is_sign = false;    ///< the first start character is neither a letter nor a digit
};

/// A description compiled into flat tables for the scanner. Shared between the parsers of one device.
struct Plan {
  std::vector<KindPlan> kinds;
  std::array<bool, 256> starts{};  ///< first bytes of frames
  std::array<bool, 256> ends{};    ///< ends of lines without start characters
  int sole_start = -1;             ///< the only first byte there is, if there is only one
  bool any_starts_anywhere = false;
  bool beginning_counts = false;  ///< such a line can also begin at the very beginning: it has a checksum
};

[[nodiscard]] std::shared_ptr<const Plan> compile(const Description& description);

/// Unsigned or signed integer at `p`, as it stands. Types of text and floats have none: 0.
[[nodiscard]] std::int64_t integer_at(const std::uint8_t* p, Type type, bool is_big);

}  // namespace navcal::protocols::described
