// SPDX-License-Identifier: Apache-2.0
#include "protocols/samples_line.h"

#include <algorithm>
#include <cstring>

namespace navcal::protocols::samples_line {
namespace {

const std::uint8_t* find_byte(const std::uint8_t* first, const std::uint8_t* last, char byte) {
  if (first == last) return last;
  const void* const found = std::memchr(first, byte, static_cast<std::size_t>(last - first));
  return found == nullptr ? last : static_cast<const std::uint8_t*>(found);
}

/// Whether `{"` stands anywhere in [first, last).
bool has_next_begin(const std::uint8_t* first, const std::uint8_t* last) {
  for (const std::uint8_t* p = find_byte(first, last, '{'); p != last; p = find_byte(p + 1, last, '{')) {
    if (last - p > 1 && p[1] == '"') return true;
  }
  return false;
}

FrameId class_of(std::string_view line) {
  constexpr std::string_view kHead = "{\"class\":";
  constexpr FrameId kUnnamed{"SAMPLE"};
  if (!line.starts_with(kHead)) return kUnnamed;
  line.remove_prefix(kHead.size());
  while (line.starts_with(' ')) line.remove_prefix(1);
  if (!line.starts_with('"')) return kUnnamed;
  line.remove_prefix(1);
  const std::size_t end = line.find('"');
  constexpr std::size_t kLongest = 16;
  if (end == std::string_view::npos || end == 0 || end > kLongest) return kUnnamed;
  const std::string_view name = line.substr(0, end);
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
  return is_plain ? FrameId{name} : kUnnamed;
}

}  // namespace

const std::uint8_t* Scanner::find_start(const std::uint8_t* first, const std::uint8_t* last) {
  return find_byte(first, last, '{');
}

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = std::min(static_cast<std::size_t>(last - first), kMaxLength);
  const std::uint8_t* const limit = first + available;
  if (available > 1 && first[1] != '"' && first[1] != ' ' && first[1] != '\t') return Scan::not_a_frame();
  const std::uint8_t* const end = find_byte(first + 1, limit, '\n');
  if (has_next_begin(first + 1, end)) return Scan::not_a_frame();
  if (end == limit) {
    if (available == kMaxLength) return Scan::not_a_frame();
    const std::size_t missing = available > 1 && limit[-1] == '}' ? 1 : 2;
    return Scan::incomplete(std::min(missing, kMaxLength - available));
  }
  const std::uint8_t* const close = end[-1] == '\r' ? end - 2 : end - 1;
  if (close <= first || *close != '}') return Scan::bad_checksum();
  const auto length = static_cast<std::size_t>(end + 1 - first);
  return Scan::frame(length, class_of({reinterpret_cast<const char*>(first), length}));
}

}  // namespace navcal::protocols::samples_line
