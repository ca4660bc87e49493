// SPDX-License-Identifier: Apache-2.0
#include "protocols/paroscientific.h"

#include <array>
#include <string>

#include "protocols/decimal.h"

namespace navcal::protocols::paroscientific {
namespace {

constexpr std::size_t kTextBegin = 5;  // behind the star and four digits

bool is_digit(std::uint8_t byte) { return byte >= '0' && byte <= '9'; }
bool is_letter(std::uint8_t byte) { return byte >= 'A' && byte <= 'Z'; }
bool is_printed(std::uint8_t byte) { return byte >= ' ' && byte <= '~' && byte != '*'; }

/// Whether a line can go on with `byte` at `i`; the shape is that of the first character of its text.
bool may_follow(const std::uint8_t* first, std::size_t i) {
  const std::uint8_t byte = first[i];
  if (i < kTextBegin) return i == 0 || is_digit(byte);
  if (i == kTextBegin) return is_letter(byte) || is_digit(byte) || byte == '-';
  if (!is_letter(first[kTextBegin])) return is_digit(byte) || byte == '.';
  if (i == kTextBegin + 1) return is_letter(byte) || is_digit(byte);
  if (i == kTextBegin + 2) return byte == '=';
  return is_printed(byte);
}

std::string_view text_of(Bytes frame) {
  std::string_view text(reinterpret_cast<const char*>(frame.data()), frame.size());
  text.remove_prefix(std::min(text.size(), kTextBegin));
  while (text.ends_with('\n') || text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

FrameId id_of(const std::uint8_t* first) {
  if (!is_letter(first[kTextBegin])) return kValue;
  return FrameId(std::string_view(reinterpret_cast<const char*>(first) + kTextBegin, 2));
}

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = std::min(static_cast<std::size_t>(last - first), kMaxFrameLength);
  // A line has at least a digit, or a command of two letters.
  const auto is_whole = [&](std::size_t end) {
    return end > kTextBegin && (!is_letter(first[kTextBegin]) || end > kTextBegin + 1);
  };
  for (std::size_t i = 0; i < available; ++i) {
    if (first[i] == '\n') return is_whole(i) ? Scan::frame(i + 1, id_of(first)) : Scan::not_a_frame();
    if (first[i] == '\r') {
      if (!is_whole(i) || i + 1 == kMaxFrameLength) return Scan::not_a_frame();
      if (i + 1 == available) return Scan::incomplete(1);
      return first[i + 1] == '\n' ? Scan::frame(i + 2, id_of(first)) : Scan::not_a_frame();
    }
    if (!may_follow(first, i)) return Scan::not_a_frame();
  }
  return available == kMaxFrameLength ? Scan::not_a_frame() : Scan::incomplete(1);
}

Address address_of(Bytes frame) {
  if (frame.size() < kTextBegin) return {};
  const auto number = [&](std::size_t i) {
    return static_cast<std::uint8_t>(10 * (frame[i] - '0') + (frame[i + 1] - '0'));
  };
  return {number(1), number(3)};
}

std::optional<double> decode_value(Bytes frame) {
  const std::string_view text = text_of(frame);
  return text.find('.') == std::string_view::npos ? std::nullopt : decimal(text);
}

std::string_view parameter_of(Bytes frame) {
  const std::string_view text = text_of(frame);
  const std::size_t equals = text.find('=');
  return equals == std::string_view::npos ? std::string_view{} : text.substr(equals + 1);
}

std::optional<double> unit_Pa(int code) {
  constexpr std::array<double, 8> kUnits_Pa{6894.757293168, 1e2, 1e5, 1e3, 1e6, 3386.389, 133.322387415, 9806.65};
  if (code < 1 || code > static_cast<int>(kUnits_Pa.size())) return std::nullopt;
  return kUnits_Pa[static_cast<std::size_t>(code - 1)];
}

std::vector<std::uint8_t> encode_line(Address address, std::string_view text) {
  std::string line = "*";
  for (const std::uint8_t number : {address.to, address.from}) {
    line += static_cast<char>('0' + number / 10 % 10);
    line += static_cast<char>('0' + number % 10);
  }
  line += text;
  line += "\r\n";
  return {line.begin(), line.end()};
}

}  // namespace navcal::protocols::paroscientific
