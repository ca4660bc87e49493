// SPDX-License-Identifier: Apache-2.0
#include "record/json/json_object.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/durations.h"

namespace navcal::record {
namespace {

void append_double(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  std::array<char, 32> digits;
  out.append(digits.data(), fmt::format_to(digits.data(), FMT_COMPILE("{}"), value));
}

void append_double(std::string& out, const std::optional<double>& value) {
  append_double(out, value.value_or(std::nan("")));
}

template <class Values>
void append_list(std::string& out, const Values& values) {
  char separator = '[';
  for (const auto& value : values) {
    out += separator;
    append_double(out, value);
    separator = ',';
  }
  out += ']';
}

bool needs_no_escape(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; }

}  // namespace

void append_seconds(std::string& out, std::int64_t ns) {
  // Unsigned, so that the most negative time has a magnitude too.
  auto magnitude = static_cast<std::uint64_t>(ns);
  if (ns < 0) {
    out += '-';
    magnitude = 0 - magnitude;
  }
  std::array<char, 32> digits;
  out.append(digits.data(), fmt::format_to(digits.data(), FMT_COMPILE("{}.{:09}"), magnitude / base::kSecond_ns,
                                           magnitude % base::kSecond_ns));
}

JsonObject::JsonObject(std::string& out, std::string_view class_name) : out_(out) {
  out_ += "{\"class\":\"";
  out_ += class_name;
  out_ += '"';
}

void JsonObject::begin(std::string_view key) {
  out_ += ",\"";
  out_ += key;
  out_ += "\":";
}

void JsonObject::seconds(std::string_view key, std::int64_t ns) {
  begin(key);
  append_seconds(out_, ns);
}

void JsonObject::number(std::string_view key, double value) {
  begin(key);
  append_double(out_, value);
}

void JsonObject::number(std::string_view key, const std::optional<double>& value) {
  begin(key);
  append_double(out_, value);
}

void JsonObject::numbers(std::string_view key, const std::array<double, 3>& values) {
  begin(key);
  append_list(out_, values);
}

void JsonObject::numbers(std::string_view key, const std::array<std::optional<double>, 3>& values) {
  begin(key);
  append_list(out_, values);
}

void JsonObject::integer(std::string_view key, std::int64_t value) {
  begin(key);
  const fmt::format_int digits(value);
  out_.append(digits.data(), digits.size());
}

void JsonObject::boolean(std::string_view key, bool value) {
  begin(key);
  out_ += value ? "true" : "false";
}

void JsonObject::text(std::string_view key, std::string_view value) {
  begin(key);
  if (std::all_of(value.begin(), value.end(), needs_no_escape)) {
    out_ += '"';
    out_ += value;
    out_ += '"';
  } else {
    out_ += nlohmann::json(value).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  }
}

void JsonObject::raw(std::string_view key, std::string_view json) {
  begin(key);
  out_ += json;
}

void JsonObject::null(std::string_view key) {
  begin(key);
  out_ += "null";
}

}  // namespace navcal::record
