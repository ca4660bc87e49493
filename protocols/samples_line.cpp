// SPDX-License-Identifier: Apache-2.0
#include "protocols/samples_line.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "protocols/decimal.h"

namespace navcal::protocols::samples_line {

namespace {

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

namespace {

/// Bytes of the UTF-8 sequence at the beginning of `text`; 0 when it is none.
std::size_t utf8_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  }
  // Not the shortest form, a surrogate, or beyond the last code point.
  if (length < 3) return length;
  const auto second = static_cast<unsigned char>(text[1]);
  const bool is_wrong = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
  return is_wrong ? 0 : length;
}

/// `{` is escaped too: the bytes `{"` begin a line and nothing else.
void append_escaped(std::string& text, char c) {
  constexpr char kDigits[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= ' ' && c != '"' && c != '\\' && c != '{') {
    text += c;
  } else {
    text += "\\u00";
    text += kDigits[byte >> 4];
    text += kDigits[byte & 0x0F];
  }
}

}  // namespace

LineWriter::LineWriter(std::string_view class_name) {
  line_ = "{\"class\":\"";
  line_ += class_name;
  line_ += '"';
}

void LineWriter::begin(std::string_view key) {
  line_ += ",\"";
  line_ += key;
  line_ += "\":";
}

LineWriter& LineWriter::seconds(std::string_view key, std::int64_t ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  if (ns < 0) return *this;
  begin(key);
  line_ += std::to_string(ns / kSecond_ns);
  const std::string decimals = std::to_string(ns % kSecond_ns);
  line_ += '.';
  line_.append(9 - decimals.size(), '0');
  line_ += decimals;
  return *this;
}

LineWriter& LineWriter::number(std::string_view key, double value) {
  if (!std::isfinite(value)) return *this;
  begin(key);
  append_shortest(line_, value);
  return *this;
}

LineWriter& LineWriter::number(std::string_view key, const std::optional<double>& value) {
  return value ? number(key, *value) : *this;
}

LineWriter& LineWriter::vector(std::string_view key, const std::array<double, 3>& values) {
  const bool is_finite = std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2]);
  return is_finite ? three(key, {values[0], values[1], values[2]}) : *this;
}

LineWriter& LineWriter::three(std::string_view key, const std::array<std::optional<double>, 3>& values) {
  begin(key);
  for (std::size_t i = 0; i < values.size(); ++i) {
    line_ += i == 0 ? '[' : ',';
    if (values[i] && std::isfinite(*values[i])) {
      append_shortest(line_, *values[i]);
    } else {
      line_ += "null";
    }
  }
  line_ += ']';
  return *this;
}

LineWriter& LineWriter::text(std::string_view key, std::string_view value) {
  begin(key);
  line_ += '"';
  while (!value.empty()) {
    const std::size_t length = utf8_length(value);
    if (length == 1) {
      append_escaped(line_, value.front());
    } else {
      line_ += length == 0 ? std::string_view("\xEF\xBF\xBD") : value.substr(0, length);
    }
    value.remove_prefix(std::max<std::size_t>(length, 1));
  }
  line_ += '"';
  return *this;
}

LineWriter& LineWriter::boolean(std::string_view key, bool value) {
  begin(key);
  line_ += value ? "true" : "false";
  return *this;
}

std::string LineWriter::finish() {
  line_ += "}\n";
  return std::exchange(line_, {});
}

}  // namespace navcal::protocols::samples_line
