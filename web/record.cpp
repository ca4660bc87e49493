// SPDX-License-Identifier: Apache-2.0
#include "web/record.h"

#include "record/json/mapping_json.h"

namespace navcal::web {
namespace {

constexpr std::string_view kHead = R"({"class":"RECORD","topic":")";

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
    const std::string_view seconds = line.substr(0, line.find(','));
    record.utc_ns = record::nanoseconds(seconds);
    if (!record.utc_ns || *record.utc_ns < 0) return std::nullopt;
    line.remove_prefix(seconds.size());
  }
  if (!take(line, R"(,"message":)") || line.size() < 3 || line.front() != '{') return std::nullopt;
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  if (!line.ends_with("}}")) return std::nullopt;
  line.remove_suffix(1);
  record.message = line;
  return record;
}

}  // namespace navcal::web
