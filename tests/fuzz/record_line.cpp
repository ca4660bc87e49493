// SPDX-License-Identifier: Apache-2.0
// Lines of the status socket: a record that is understood lies within its line, and written again it is the same
// one.
#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/fuzz/target.h"
#include "web/record.h"

namespace navcal::fuzz::record_line_target {

NAVCAL_FUZZ(record_line) {
  using namespace navcal::web;
  // Half of the inputs get the head that a record needs, so that the fuzzer finds the rest of it.
  std::string line(reinterpret_cast<const char*>(data), size);
  if (size > 0 && data[0] % 2 == 1) line = R"({"class":"RECORD","topic":")" + line.substr(1);
  const auto record = read_record(line);
  if (!record) return 0;
  const auto is_within = [&](std::string_view part) {
    return part.empty() || (part.data() >= line.data() && part.data() + part.size() <= line.data() + line.size());
  };
  if (!is_within(record->topic) || !is_within(record->device) || !is_within(record->message)) std::abort();
  if (record->topic.empty() || record->message.front() != '{' || record->message.back() != '}') std::abort();
  const std::string device = record->device.empty() ? "null" : fmt::format("\"{}\"", record->device);
  const std::string time =
      record->utc_ns ? fmt::format("{}.{:09}", *record->utc_ns / 1'000'000'000, *record->utc_ns % 1'000'000'000)
                     : "null";
  const std::string again = fmt::format(R"({{"class":"RECORD","topic":"{}","device":{},"time":{},"message":{}}})",
                                        record->topic, device, time, record->message);
  const auto same = read_record(again);
  if (!same || same->topic != record->topic || same->device != record->device || same->utc_ns != record->utc_ns ||
      same->message != record->message)
    std::abort();
  return 0;
}

}  // namespace navcal::fuzz::record_line_target
