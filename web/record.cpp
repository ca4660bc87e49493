// SPDX-License-Identifier: Apache-2.0
#include "web/record.h"

#include <charconv>

namespace navcal::web {
namespace {

constexpr std::string_view kHead = R"({"class":"RECORD","topic":")";
constexpr std::int64_t kNanoseconds = 1'000'000'000;

/// Takes `expected` from the front of `text`; false when something else stands there.
bool take(std::string_view& text, std::string_view expected) {
  if (!text.starts_with(expected)) return false;
  text.remove_prefix(expected.size());
  return true;
}

/// Takes a name up to its closing quote. Names of topics and ports need no escapes.
std::optional<std::string_view> take_name(std::string_view& text) {
  const auto end = text.find_first_of("\"\\");
  if (end == std::string_view::npos || text[end] == '\\') return std::nullopt;
  const auto name = text.substr(0, end);
  text.remove_prefix(end + 1);
  return name;
}

/// Takes seconds with up to nine decimals as nanoseconds: a double would lose the last digits.
std::optional<std::int64_t> take_seconds(std::string_view& text) {
  std::int64_t seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  // Later than the year 2262 has no nanoseconds of 64 bits.
  if (error != std::errc() || seconds < 0 || seconds > 9'000'000'000) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  std::int64_t fraction = 0;
  if (take(text, ".")) {
    std::int64_t digit = kNanoseconds / 10;
    while (!text.empty() && text.front() >= '0' && text.front() <= '9') {
      fraction += (text.front() - '0') * digit;
      digit /= 10;
      text.remove_prefix(1);
    }
  }
  return seconds * kNanoseconds + fraction;
}

}  // namespace

std::optional<Record> read_record(std::string_view line) {
  Record record;
  if (!take(line, kHead)) return std::nullopt;
  const auto topic = take_name(line);
  if (!topic || topic->empty()) return std::nullopt;
  record.topic = *topic;
  if (take(line, R"(,"device":)") && !take(line, "null")) {
    const auto device = take(line, "\"") ? take_name(line) : std::nullopt;
    if (!device) return std::nullopt;
    record.device = *device;
  }
  if (take(line, R"(,"time":)") && !take(line, "null")) {
    record.utc_ns = take_seconds(line);
    if (!record.utc_ns) return std::nullopt;
  }
  if (!take(line, R"(,"message":)") || line.size() < 3 || line.front() != '{') return std::nullopt;
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  if (!line.ends_with("}}")) return std::nullopt;
  line.remove_suffix(1);
  record.message = line;
  return record;
}

}  // namespace navcal::web
