// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_fields.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

namespace navcal::analysis {
namespace {

constexpr std::size_t kLongestNumber = 32;
constexpr std::array<double, 10> kPowers{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr double kLargestScaled = 9e15;  // beyond, a double has no room for the decimals

char* put(char* p, std::string_view text) {
  std::memcpy(p, text.data(), text.size());
  return p + text.size();
}

char* put_two(char* p, unsigned value) {
  p[0] = static_cast<char>('0' + value / 10);
  p[1] = static_cast<char>('0' + value % 10);
  return p + 2;
}

/// mantissa / 10^decimals, all decimals written.
char* put_fixed(char* p, std::int64_t mantissa, std::size_t decimals) {
  if (mantissa < 0) *p++ = '-';
  const fmt::format_int digits(mantissa < 0 ? 0U - static_cast<std::uint64_t>(mantissa)
                                            : static_cast<std::uint64_t>(mantissa));
  const std::size_t size = digits.size();
  if (decimals == 0) return put(p, {digits.data(), size});
  if (size <= decimals) {
    p = put(p, "0.");
    std::memset(p, '0', decimals - size);
    return put(p + (decimals - size), {digits.data(), size});
  }
  p = put(p, {digits.data(), size - decimals});
  *p++ = '.';
  return put(p, {digits.data() + size - decimals, decimals});
}

}  // namespace

void FieldWriter::begin_frame(std::string_view protocol, const protocols::Frame& frame) {
  const std::string_view id = frame.id.view();
  char* p = output_.room(256);
  if (json_) {
    p = put(p, R"({"class":"FRAME","protocol":")");
    p = put(p, protocol);
    p = put(p, R"(","id":")");
    p = put(p, id);
    p = put(p, R"(","offset":)");
    const fmt::format_int offset(frame.offset);
    p = put(p, {offset.data(), offset.size()});
    p = put(p, R"(,"length":)");
    const fmt::format_int length(frame.bytes.size());
    p = put(p, {length.data(), length.size()});
  } else {
    p = fmt::format_to(p, FMT_COMPILE("{:>12} {:>4} {:<8}"), frame.offset, frame.bytes.size(), id);
  }
  output_.wrote(p);
  first_ = has_fields_ = false;
}

void FieldWriter::begin_field(std::string_view key) {
  has_fields_ = true;
  char* p = output_.room(key.size() + 4);
  if (json_) {
    if (!first_) *p++ = ',';
    if (!key.empty()) {
      *p++ = '"';
      p = put(p, key);
      p = put(p, "\":");
    }
  } else {
    if (!first_) *p++ = ' ';
    if (!key.empty()) {
      p = put(p, key);
      *p++ = '=';
    }
  }
  output_.wrote(p);
  first_ = false;
}

void FieldWriter::open(std::string_view key, char bracket) {
  begin_field(key);
  output_.append(bracket);
  first_ = true;
}

void FieldWriter::close(char bracket) {
  output_.append(bracket);
  first_ = false;
}

void FieldWriter::null(std::string_view key) {
  if (!json_ && !key.empty()) return;
  begin_field(key);
  output_.append(json_ ? std::string_view("null") : std::string_view("-"));
}

void FieldWriter::number(std::string_view key, double value) {
  begin_field(key);
  char* const p = output_.room(kLongestNumber);
  output_.wrote(std::to_chars(p, p + kLongestNumber, value).ptr);
}

void FieldWriter::write_integer(std::int64_t value) {
  output_.wrote(put_fixed(output_.room(kLongestNumber), value, 0));
}

void FieldWriter::write_number(double value, int decimals) {
  const double scaled = value * kPowers[static_cast<std::size_t>(decimals)];
  char* const begin = output_.room(kLongestNumber);
  if (!(std::fabs(scaled) < kLargestScaled)) {
    output_.wrote(std::to_chars(begin, begin + kLongestNumber, value).ptr);
    return;
  }
  // Half away from zero; the conversion is exact below 2^53.
  char* end = put_fixed(begin, static_cast<std::int64_t>(scaled + (scaled < 0 ? -0.5 : 0.5)),
                        static_cast<std::size_t>(decimals));
  if (decimals > 0) {
    while (end[-1] == '0') --end;
    if (end[-1] == '.') --end;
  }
  output_.wrote(end);
}

void FieldWriter::write_decimal(const protocols::nmea::Decimal& value) {
  output_.wrote(put_fixed(output_.room(kLongestNumber), value.mantissa, value.decimals));
}

void FieldWriter::text(std::string_view key, std::string_view value) {
  begin_field(key);
  const bool quoted = json_ || value.find(' ') != std::string_view::npos;
  if (quoted) output_.append('"');
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    char* p = output_.room(6);
    if (byte < 0x20 || byte > 0x7E) {
      p = fmt::format_to(p, FMT_COMPILE("\\u{:04x}"), static_cast<unsigned>(byte));
    } else {
      if (c == '"' || c == '\\') *p++ = '\\';
      *p++ = c;
    }
    output_.wrote(p);
  }
  if (quoted) output_.append('"');
}

void FieldWriter::letter(std::string_view key, char value) {
  if (value == '\0') return null(key);
  text(key, {&value, 1});
}

void FieldWriter::write_time(const protocols::TimeOfDay& time) {
  char* p = output_.room(kLongestNumber);
  p = put_two(p, time.hour);
  *p++ = ':';
  p = put_two(p, time.minute);
  *p++ = ':';
  p = put_two(p, time.second);
  if (time.nanosecond != 0) {
    *p++ = '.';
    const fmt::format_int digits(1'000'000'000U + time.nanosecond);  // the leading 1 keeps the zeros
    std::size_t decimals = 9;
    if (time.nanosecond % 1'000'000 == 0) {
      decimals = 3;
    } else if (time.nanosecond % 1000 == 0) {
      decimals = 6;
    }
    p = put(p, {digits.data() + 1, decimals});
  }
  output_.wrote(p);
}

void FieldWriter::time(std::string_view key, const protocols::Date& date, const protocols::TimeOfDay& time) {
  begin_field(key);
  char* p = output_.room(kLongestNumber);
  if (json_) *p++ = '"';
  p = put_two(p, date.year / 100U);
  p = put_two(p, date.year % 100U);
  *p++ = '-';
  p = put_two(p, date.month);
  *p++ = '-';
  p = put_two(p, date.day);
  *p++ = 'T';
  output_.wrote(p);
  write_time(time);
  output_.append(json_ ? std::string_view("Z\"") : std::string_view("Z"));
}

void FieldWriter::time_of_day(std::string_view key, const protocols::TimeOfDay& time) {
  begin_field(key);
  if (json_) output_.append('"');
  write_time(time);
  if (json_) output_.append('"');
}

}  // namespace navcal::analysis
