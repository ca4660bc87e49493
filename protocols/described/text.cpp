// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/text.h"

#include <algorithm>
#include <cmath>

#include "protocols/decimal.h"
#include "protocols/nmea_decimal.h"
#include "protocols/text_fields.h"

namespace navcal::protocols::described {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view as_text(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// `use(field)` for each field; a blank as separator stands for any number of them.
template <class Use>
void for_each_field(char separator, std::string_view body, Use use) {
  if (separator == ' ') {
    for (std::size_t i = 0; i < body.size();) {
      while (i < body.size() && is_blank(body[i])) ++i;
      const std::size_t from = i;
      while (i < body.size() && !is_blank(body[i])) ++i;
      if (i > from) use(body.substr(from, i - from));
    }
    return;
  }
  while (true) {
    const std::size_t end = body.find(separator);
    use(body.substr(0, end));
    if (end == std::string_view::npos) return;
    body.remove_prefix(end + 1);
  }
}

std::optional<double> number_in_hex(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  if (is_negative) text.remove_prefix(1);
  if (text.starts_with("0x") || text.starts_with("0X")) text.remove_prefix(2);
  const auto value = integer<std::uint64_t>(text, 16);
  if (!value) return std::nullopt;
  return is_negative ? -static_cast<double>(*value) : static_cast<double>(*value);
}

std::optional<double> plain_number(std::string_view text) {
  if (const auto exact = nmea::parse_decimal(text)) return exact->value();
  return signed_number(text);
}

/// `dddmm.mmm`: the last two digits before the point are minutes.
std::optional<double> number_in_minutes(std::string_view text) {
  const auto number = plain_number(text);
  if (!number || *number < 0) return std::nullopt;
  const double degrees = std::floor(*number / 100);
  const double minutes = *number - 100 * degrees;
  if (minutes >= 60) return std::nullopt;
  return degrees + minutes / 60;
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

Bytes without_end(const KindPlan& kind, Bytes line) {
  Bytes text = line.first(line.size() - 1);
  if (kind.end == '\n' && !text.empty() && text.back() == '\r') text = text.first(text.size() - 1);
  return text;
}

Bytes body_of(const KindPlan& kind, Bytes line) {
  Bytes text = without_end(kind, line);
  if (kind.sum_size > 0) {
    const auto mark = std::find(text.rbegin(), text.rend(), static_cast<std::uint8_t>(kind.checksum.mark));
    if (mark != text.rend()) text = text.first(static_cast<std::size_t>(text.rend() - mark) - 1);
  }
  return text.subspan(std::min(kind.start.size(), text.size()));
}

std::size_t count_fields(const KindPlan& kind, Bytes body) {
  std::size_t count = 0;
  for_each_field(kind.separator, as_text(body), [&](std::string_view) { ++count; });
  return count;
}

void split(char separator, Bytes body, TextFields& into) {
  into.count = 0;
  for_each_field(separator, as_text(body), [&](std::string_view field) {
    if (into.count < into.fields.size()) into.fields[into.count++] = field;
  });
}

std::optional<double> number_of(std::string_view text, Type type) {
  if (type == Type::nmea) {
    const auto exact = nmea::parse_decimal(text);
    return exact ? std::optional(exact->value()) : std::nullopt;
  }
  text = without_blanks(text);
  switch (type) {
    case Type::hex: return number_in_hex(text);
    case Type::degrees_minutes: return number_in_minutes(text);
    default: return plain_number(text);
  }
}

}  // namespace navcal::protocols::described
