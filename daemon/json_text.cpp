// SPDX-License-Identifier: Apache-2.0
#include "daemon/json_text.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>

namespace navcal::daemon {
namespace {

constexpr std::array<std::int64_t, 10> kPowersOfTen{1,       10,        100,        1'000,       10'000,
                                                    100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};
/// Limit above which a rounded value times 10^9 does not fit 64 bits.
constexpr double kLargestScaled = 9e18;

/// Room for two 64-bit integers and what stands between them.
using Digits = std::array<char, 48>;

/// Compiled format and a buffer of fixed size: this is the larger part of the time from byte to socket.
template <class Format, class... Values>
void append_format(std::string& out, const Format& format, Values... values) {
  Digits digits;
  out.append(digits.data(), fmt::format_to(digits.data(), format, values...));
}

/// The digits after the decimal point, `decimals` of them.
void append_fraction(std::string& out, std::int64_t fraction, int decimals) {
  append_format(out, FMT_COMPILE(".{:0{}}"), fraction, decimals);
}

/// False when `value` cannot be written with that many places: infinite, not a number, or huge.
bool append_rounded(std::string& out, double value, int decimals, bool trim) {
  const std::int64_t scale = kPowersOfTen[static_cast<std::size_t>(decimals)];
  const double scaled = value * static_cast<double>(scale);
  if (!(std::abs(scaled) < kLargestScaled)) return false;
  const std::int64_t rounded = std::llround(scaled);
  const std::int64_t magnitude = std::abs(rounded);
  if (rounded < 0) out += '-';
  append_format(out, FMT_COMPILE("{}"), magnitude / scale);
  std::int64_t fraction = magnitude % scale;
  if (trim) {
    for (; decimals > 0 && fraction % 10 == 0; --decimals) fraction /= 10;
  }
  if (decimals > 0) append_fraction(out, fraction, decimals);
  return true;
}

void append_number(std::string& out, double value, int decimals, bool trim) {
  if (append_rounded(out, value, decimals, trim)) return;
  if (std::isfinite(value)) {
    append_format(out, FMT_COMPILE("{}"), value);
  } else {
    out += "null";
  }
}

}  // namespace

void append_quoted(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte >= 0x7f) {
      append_format(out, FMT_COMPILE("\\u{:04x}"), byte);
    } else {
      out += c;
    }
  }
  out += '"';
}

void append_quoted_list(std::string& out, const std::vector<std::string>& texts) {
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0) out += ',';
    append_quoted(out, texts[i]);
  }
}

void append_fixed(std::string& out, double value, int decimals) { append_number(out, value, decimals, false); }

void append_shortest(std::string& out, double value, int decimals) { append_number(out, value, decimals, true); }

void append_utc(std::string& out, std::int64_t utc_ns, int decimals) {
  using namespace std::chrono;
  const sys_time<nanoseconds> time{nanoseconds(utc_ns)};
  const auto midnight = floor<days>(time);
  const year_month_day date{midnight};
  const hh_mm_ss of_day{floor<nanoseconds>(time - midnight)};
  append_format(out, FMT_COMPILE("\"{:04}-{:02}-{:02}T{:02}:{:02}:{:02}"), static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), of_day.hours().count(),
                of_day.minutes().count(), of_day.seconds().count());
  if (decimals > 0) {
    append_fraction(out, of_day.subseconds().count() / kPowersOfTen[static_cast<std::size_t>(9 - decimals)],
                    decimals);
  }
  out += "Z\"";
}

}  // namespace navcal::daemon
