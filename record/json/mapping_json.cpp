// SPDX-License-Identifier: Apache-2.0
#include "record/json/mapping_json.h"

#include <array>

#include "base/durations.h"
#include "base/enum_name.h"
#include "protocols/decimal.h"
#include "record/json/flat_json.h"
#include "record/json/json_object.h"

namespace navcal::record {
using pipeline::UtcMapping;

void append_json(std::string& out, std::int64_t now_ns, const UtcMapping& mapping) {
  JsonObject json(out, "TIME");
  json.seconds("time", mapping.to_utc(now_ns));
  json.seconds("monotonic", now_ns);
  json.text("source", pipeline::name_of(mapping.source));
  json.seconds("offset", mapping.offset_ns);
  if (mapping.bound_ns == UtcMapping::kUnknownBound) {
    json.null("bound");
  } else {
    json.seconds("bound", mapping.bound_ns);
  }
  json.seconds("at", mapping.at_ns);
}

std::optional<UtcMapping> mapping_from_json(std::string_view json) {
  const auto members = FlatJson::parse(json);
  if (!members) return std::nullopt;
  const auto source =
      base::enum_named<UtcMapping::Source::gps>(members->get("source"), [](auto s) { return name_of(s); });
  const auto offset = nanoseconds(members->get("offset"));
  const auto at = nanoseconds(members->get("at"));
  const std::string* const bound_text = members->find("bound");
  if (!source || !offset || !at || bound_text == nullptr) return std::nullopt;
  UtcMapping mapping{*source, *offset, UtcMapping::kUnknownBound, *at};
  if (!bound_text->empty()) {
    const auto bound = nanoseconds(*bound_text);
    if (!bound) return std::nullopt;
    mapping.bound_ns = *bound;
  }
  return mapping;
}

std::optional<std::int64_t> nanoseconds(std::string_view seconds) {
  const bool negative = !seconds.empty() && seconds.front() == '-';
  if (negative) seconds.remove_prefix(1);
  const std::size_t dot = seconds.find('.');
  const std::string_view whole = seconds.substr(0, dot);
  const std::string_view fraction = dot == std::string_view::npos ? std::string_view{} : seconds.substr(dot + 1);
  if (whole.empty() || fraction.size() > 9 || (dot != std::string_view::npos && fraction.empty()))
    return std::nullopt;

  std::array<char, 9> padded;
  padded.fill('0');
  fraction.copy(padded.data(), fraction.size());
  const auto s = protocols::integer<std::uint64_t>(whole);
  const auto ns = protocols::integer<std::uint64_t>({padded.data(), padded.size()});
  // The greatest whole second of a 64-bit nanosecond count, less one, so that the sum below cannot overflow.
  if (!s || !ns || *s >= INT64_MAX / base::kSecond_ns) return std::nullopt;
  const auto total = static_cast<std::int64_t>(*s * base::kSecond_ns + *ns);
  return negative ? -total : total;
}

}  // namespace navcal::record
