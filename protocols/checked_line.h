// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/decimal.h"
#include "protocols/frame.h"
#include "protocols/stream_parser.h"

namespace navcal::protocols {

/// XOR of all bytes: the checksum of TCM2 words, motor card lines and NMEA 0183, between `$` and `*`.
[[nodiscard]] constexpr std::uint8_t xor_of(Bytes bytes) {
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : bytes) sum ^= byte;
  return sum;
}

namespace detail {

/// Value of a hexadecimal digit of either case, 255 for any other byte.
inline constexpr auto kHexValue = [] {
  std::array<std::uint8_t, 256> table{};
  table.fill(255);
  for (std::uint8_t i = 0; i < 10; ++i) table[std::size_t{'0'} + i] = i;
  for (std::uint8_t i = 0; i < 6; ++i) {
    table[std::size_t{'A'} + i] = static_cast<std::uint8_t>(10 + i);
    table[std::size_t{'a'} + i] = static_cast<std::uint8_t>(10 + i);
  }
  return table;
}();

/// Whether a byte ends the body of a line, whole or cut: `$`, `*` and all control characters, CR and LF among
/// them.
[[nodiscard]] constexpr bool ends_body(std::uint8_t byte) { return byte == '$' || byte == '*' || byte < ' '; }

/// The same for eight bytes at once. The lowest 0x80 that is set marks the first byte that ends the body; those
/// above it may be set for no reason (a borrow goes upwards only).
[[nodiscard]] constexpr std::uint64_t body_ends(std::uint64_t bytes) {
  constexpr std::uint64_t kOnes = 0x0101010101010101;
  const auto below = [](std::uint64_t x, std::uint64_t limit) { return (x - limit * kOnes) & ~x; };
  return (below(bytes ^ '$' * kOnes, 1) | below(bytes ^ '*' * kOnes, 1) | below(bytes, ' ')) & 0x80 * kOnes;
}

/// XOR of the eight bytes of a word.
[[nodiscard]] constexpr std::uint8_t folded(std::uint64_t bytes) {
  bytes ^= bytes >> 32;
  bytes ^= bytes >> 16;
  bytes ^= bytes >> 8;
  return static_cast<std::uint8_t>(bytes);
}

/// Goes over the body that begins at `p`, XORs it into `sum`; returns its end, or `limit`.
[[nodiscard]] inline const std::uint8_t* pass_body(const std::uint8_t* p, const std::uint8_t* limit,
                                                   std::uint8_t& sum) {
  if constexpr (std::endian::native == std::endian::little) {
    std::uint64_t sums = 0;
    for (; limit - p >= 8; p += 8) {
      std::uint64_t bytes = 0;
      std::memcpy(&bytes, p, sizeof bytes);
      if (const std::uint64_t ends = body_ends(bytes); ends != 0) {
        const int before = std::countr_zero(ends) / 8;
        sums ^= bytes & ((std::uint64_t{1} << 8 * before) - 1);
        sum = static_cast<std::uint8_t>(sum ^ folded(sums));
        return p + before;
      }
      sums ^= bytes;
    }
    sum = static_cast<std::uint8_t>(sum ^ folded(sums));
  }
  for (; p < limit && !ends_body(*p); ++p) sum ^= *p;
  return p;
}

}  // namespace detail

/// Scans a line `$...*hh<CR><LF>` that begins at `first` (a `$`). Any number of <CR> and blanks may stand before
/// the <LF>: terminals, files and serial drivers leave out the <CR> or add some. Whatever is no control character
/// is let into the body, for a flipped bit is better counted as a bad checksum than as something else; but a `$`
/// begins the next line, so a line that was cut is left without waiting. `max_length` counts everything from `$`
/// to <LF>. Without `requires_checksum` a line may lack `*hh`.
[[nodiscard]] inline Scan scan_checked_line(const std::uint8_t* first, const std::uint8_t* last,
                                            std::size_t max_length, FrameId id, bool requires_checksum = true) {
  const auto available = std::min(static_cast<std::size_t>(last - first), max_length);
  const std::uint8_t* const limit = first + available;
  const auto unfinished = [&](std::size_t missing) {
    return available == max_length ? Scan::not_a_frame()
                                   : Scan::incomplete(std::min(missing, max_length - available));
  };
  std::uint8_t sum = 0;
  const std::uint8_t* p = detail::pass_body(first + 1, limit, sum);
  if (p == limit) return unfinished(requires_checksum ? 4 : 1);
  if (*p == '$') return Scan::not_a_frame();
  if (*p == '*') {
    const auto left = static_cast<std::size_t>(limit - p);
    if (left > 1 && detail::kHexValue[p[1]] != sum >> 4) return Scan::bad_checksum();
    if (left > 2 && detail::kHexValue[p[2]] != (sum & 0x0F)) return Scan::bad_checksum();
    if (left < 4) return unfinished(4 - left);
    p += 3;
  } else if (requires_checksum) {
    return Scan::bad_checksum();  // the line has ended without one
  }
  while (p != limit && (*p == '\r' || *p == ' ')) ++p;
  if (p == limit) return unfinished(1);
  return *p == '\n' ? Scan::frame(static_cast<std::size_t>(p + 1 - first), id) : Scan::bad_checksum();
}

/// The text between `$` and `*` of an intact line.
[[nodiscard]] inline std::string_view body_of(Bytes line) {
  const std::string_view text(reinterpret_cast<const char*>(line.data()), line.size());
  const std::size_t star = text.rfind('*');
  return star == std::string_view::npos || star == 0 ? std::string_view{} : text.substr(1, star - 1);
}

/// `$` + body + `*hh<CR><LF>`, checksum in upper case.
[[nodiscard]] inline std::vector<std::uint8_t> checked_line(std::string_view body) {
  const std::uint8_t sum = xor_of({reinterpret_cast<const std::uint8_t*>(body.data()), body.size()});
  std::string line;
  line.reserve(body.size() + 6);
  line += '$';
  line += body;
  line += '*';
  append_hex(line, sum, 2);
  line += "\r\n";
  return {line.begin(), line.end()};
}

}  // namespace navcal::protocols
