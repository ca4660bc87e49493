// SPDX-License-Identifier: Apache-2.0
#include "protocols/tcm2.h"

#include <algorithm>
#include <string_view>

#include "protocols/checked_line.h"

namespace navcal::protocols::tcm2 {
namespace {

/// `:clock=40` and `H9V9M99.99` are the longest that are known; a colon in noise is not to hold up what follows
/// it.
constexpr std::size_t kMaxReplyLength = 32;
constexpr std::size_t kLeastWordLength = 8;  // `$C1*hh<LF>` and a digit to spare

bool may_be_in_reply(std::uint8_t byte) {
  return (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
         byte == '=' || byte == '.' || byte == '-' || byte == '+' || byte == '?';
}

bool may_be_in_banner(std::uint8_t byte) { return byte >= ' ' && byte <= '~' && byte != '$'; }

/// A line of admissible bytes and CR LF or LF; `accept` judges it as a whole once it has ended.
template <class Admissible, class Accept>
Scan scan_line(const std::uint8_t* first, const std::uint8_t* last, std::size_t max_length, FrameId id,
               Admissible admissible, Accept accept) {
  const auto available = std::min(static_cast<std::size_t>(last - first), max_length);
  const std::uint8_t* const limit = first + available;
  const std::uint8_t* p = std::find_if_not(first + 1, limit, admissible);
  if (p != limit && *p == '\r') ++p;
  if (p == limit) return available == max_length ? Scan::not_a_frame() : Scan::incomplete(1);
  const auto length = static_cast<std::size_t>(p + 1 - first);
  return *p == '\n' && accept(Bytes(first, length)) ? Scan::frame(length, id) : Scan::not_a_frame();
}

Scan scan_reply(const std::uint8_t* first, const std::uint8_t* last) {
  return scan_line(first, last, kMaxReplyLength, kReply, may_be_in_reply,
                   [](Bytes line) { return decode_reply(line).has_value(); });
}

/// Whether the first bytes agree with `start`, as far as they have come.
bool agrees(std::string_view start, const std::uint8_t* first, std::size_t available) {
  return std::equal(start.begin(), start.begin() + std::min(available, start.size()), first);
}

Scan scan_banner(const std::uint8_t* first, const std::uint8_t* last) {
  constexpr std::string_view kStart = "TCM2";
  const auto available = static_cast<std::size_t>(last - first);
  if (!agrees(kStart, first, available)) return Scan::not_a_frame();
  if (available < kStart.size()) return Scan::incomplete(kStart.size() + 1 - available);
  return scan_line(first, last, Scanner::kMaxFrameLength, kBanner, may_be_in_banner, [](Bytes) { return true; });
}

Scan scan_hchdm(const std::uint8_t* first, const std::uint8_t* last) {
  constexpr std::string_view kStart = "$HCHDM,";
  const auto available = static_cast<std::size_t>(last - first);
  if (!agrees(kStart, first, available)) return Scan::not_a_frame();
  if (available < kStart.size()) return Scan::incomplete(kStart.size() + 4 - available);
  return scan_checked_line(first, last, Scanner::kMaxFrameLength, kHchdm);
}

/// A word begins with the letter of any of its fields, for any may be switched off, and a number: that tells it
/// from NMEA sentences such as `$PTNTHTM` or `$CRMC`.
Scan scan_word(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available > 1 && kFieldLetters.find(static_cast<char>(first[1])) == std::string_view::npos) {
    return Scan::not_a_frame();
  }
  if (available > 2 && !(first[2] >= '0' && first[2] <= '9') && first[2] != '-' && first[2] != '.') {
    return Scan::not_a_frame();
  }
  if (available < 3) return Scan::incomplete(kLeastWordLength - 1 - available);
  return scan_checked_line(first, last, Scanner::kMaxFrameLength, kWord);
}

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  switch (*first) {
    case '$': return last - first > 1 && first[1] == 'H' ? scan_hchdm(first, last) : scan_word(first, last);
    case 'T': return scan_banner(first, last);
    default:  // ':' or 'H'
      return scan_reply(first, last);
  }
}

}  // namespace navcal::protocols::tcm2
