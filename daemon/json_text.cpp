#include "daemon/json_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace navcal::daemon {
namespace {

constexpr std::array<std::int64_t, 10> kPowersOfTen{1,       10,        100,        1'000,       10'000,
                                                    100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};
/// Beyond it a rounded value times 10^9 does not fit 64 bits.
constexpr double kLargestScaled = 9e18;

/// The digits after the decimal point, `decimals` of them.
void append_fraction(std::string& out, std::int64_t fraction, int decimals) {
  fmt::format_to(std::back_inserter(out), FMT_STRING(".{:0{}}"), fraction, decimals);
}

/// False when `value` cannot be written with that many places: infinite, not a number, or huge.
bool append_rounded(std::string& out, double value, int decimals, bool trim) {
  const std::int64_t scale = kPowersOfTen[static_cast<std::size_t>(decimals)];
  const double scaled = value * static_cast<double>(scale);
  if (!(std::abs(scaled) < kLargestScaled)) return false;
  const std::int64_t rounded = std::llround(scaled);
  const std::int64_t magnitude = std::abs(rounded);
  if (rounded < 0) out += '-';
  fmt::format_to(std::back_inserter(out), FMT_STRING("{}"), magnitude / scale);
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
    fmt::format_to(std::back_inserter(out), FMT_STRING("{}"), value);
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
      fmt::format_to(std::back_inserter(out), FMT_STRING("\\u{:04x}"), byte);
    } else {
      out += c;
    }
  }
  out += '"';
}

void append_fixed(std::string& out, double value, int decimals) { append_number(out, value, decimals, false); }

void append_shortest(std::string& out, double value, int decimals) { append_number(out, value, decimals, true); }

void append_utc(std::string& out, std::int64_t utc_ns, int decimals) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr std::int64_t kDay = 86'400;
  const std::int64_t fraction = ((utc_ns % kSecond) + kSecond) % kSecond;
  const std::int64_t seconds = (utc_ns - fraction) / kSecond;
  const std::int64_t of_day = ((seconds % kDay) + kDay) % kDay;
  // Civil date of a day count, with years that begin in March so that the leap day comes last.
  const std::int64_t days = (seconds - of_day) / kDay + 719'468;
  const std::int64_t era = (days >= 0 ? days : days - 146'096) / 146'097;
  const std::int64_t day_of_era = days - era * 146'097;
  const std::int64_t year_of_era =
      (day_of_era - day_of_era / 1'460 + day_of_era / 36'524 - day_of_era / 146'096) / 365;
  const std::int64_t day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const std::int64_t shifted_month = (5 * day_of_year + 2) / 153;
  const std::int64_t day = day_of_year - (153 * shifted_month + 2) / 5 + 1;
  const std::int64_t month = shifted_month < 10 ? shifted_month + 3 : shifted_month - 9;
  const std::int64_t year = year_of_era + era * 400 + (month <= 2 ? 1 : 0);
  fmt::format_to(std::back_inserter(out), FMT_STRING("\"{:04}-{:02}-{:02}T{:02}:{:02}:{:02}"), year, month, day,
                 of_day / 3'600, of_day / 60 % 60, of_day % 60);
  if (decimals > 0)
    append_fraction(out, fraction / kPowersOfTen[static_cast<std::size_t>(9 - decimals)], decimals);
  out += "Z\"";
}

}  // namespace navcal::daemon
