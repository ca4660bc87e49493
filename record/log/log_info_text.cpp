// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/durations.h"
#include "base/printable.h"
#include "base/utc_text.h"
#include "record/json/json_object.h"
#include "record/log/log_info.h"

namespace navcal::record {
namespace {

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

/// Time of day of people, or seconds where the recording never learnt UTC.
std::string when(std::int64_t utc_ns) {
  constexpr std::int64_t kYear2000_ns = 946'684'800LL * base::kSecond_ns;
  if (utc_ns < kYear2000_ns) return fmt::format("{:.3f} s (monotonic: UTC was not known)", seconds(utc_ns));
  return base::utc_text(utc_ns);
}

std::string exact(std::int64_t ns) {
  std::string text;
  append_seconds(text, ns);
  return text;
}

}  // namespace

std::string to_text(const RecordingInfo& info) {
  std::string out = fmt::format("{}: {}, {} bytes, {}\n", base::printable(info.file), info.log ? "log" : "capture",
                                info.bytes, info.finished ? "finished" : "unfinished");
  out += fmt::format("from {}\nto   {} ({:.3f} s)\n", when(info.start_utc_ns), when(info.end_utc_ns),
                     seconds(info.end_utc_ns - info.start_utc_ns));
  for (const auto& port : info.ports) {
    out += fmt::format("port {:<12} {:<10} {:>6} baud  {:>9} bytes in {} reads, {} bytes sent", port.name,
                       port.protocol, port.baud, port.received_bytes, port.reads, port.sent_bytes);
    out += fmt::format("; longest pause {:.3f} s, {} gaps\n", seconds(port.longest_gap_ns), port.gaps);
  }
  for (const auto& [topic, count] : info.topics) {
    out +=
        fmt::format("{:<22} {:>9} messages {:>11} bytes\n", base::printable(topic), count.messages, count.bytes);
  }
  for (const auto& event : info.events) {
    out += base::printable(fmt::format("event {} {} {}{}{}: {}", event.time, event.severity, event.name,
                                       event.port.empty() ? "" : " ", event.port, event.message));
    out += '\n';
  }
  if (info.further_events > 0) out += fmt::format("and {} more events\n", info.further_events);
  if (info.bad_crc > 0) out += fmt::format("{} messages whose checksum does not hold\n", info.bad_crc);
  if (info.damaged_bytes > 0) out += fmt::format("{} damaged bytes passed over\n", info.damaged_bytes);
  return out;
}

std::string to_json(const RecordingInfo& info) {
  using nlohmann::ordered_json;
  ordered_json json;
  json["file"] = info.file;
  json["kind"] = info.log ? "log" : "capture";
  json["bytes"] = info.bytes;
  json["finished"] = info.finished;
  // Times are text, because a reader's doubles would lose the last hundred nanoseconds.
  json["start"] = exact(info.start_utc_ns);
  json["end"] = exact(info.end_utc_ns);
  json["duration_s"] = seconds(info.end_utc_ns - info.start_utc_ns);
  json["ports"] = ordered_json::array();
  for (const auto& port : info.ports) {
    json["ports"].push_back({{"name", port.name},
                             {"protocol", port.protocol},
                             {"baud", port.baud},
                             {"reads", port.reads},
                             {"received_bytes", port.received_bytes},
                             {"sent", port.sent},
                             {"sent_bytes", port.sent_bytes},
                             {"longest_gap_s", seconds(port.longest_gap_ns)},
                             {"gaps", port.gaps}});
  }
  json["topics"] = ordered_json::object();
  for (const auto& [topic, count] : info.topics) {
    json["topics"][topic] = {{"messages", count.messages}, {"bytes", count.bytes}};
  }
  json["events"] = ordered_json::array();
  for (const auto& event : info.events) {
    json["events"].push_back({{"time", event.time},
                              {"severity", event.severity},
                              {"name", event.name},
                              {"port", event.port},
                              {"message", event.message}});
  }
  json["further_events"] = info.further_events;
  json["bad_crc"] = info.bad_crc;
  json["damaged_bytes"] = info.damaged_bytes;
  json["tail_bytes"] = info.tail_bytes;
  json["remarks"] = info.remarks;
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace navcal::record
