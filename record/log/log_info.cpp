// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_info.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/durations.h"
#include "base/printable.h"
#include "base/utc_text.h"
#include "record/json/flat_json.h"
#include "record/json/json_members.h"
#include "record/json/json_object.h"
#include "record/json/put_members.h"
#include "record/recording.h"

namespace navcal::record {

NAVCAL_JSON_MEMBERS(RecordingInfo::Topic, messages, bytes)
NAVCAL_JSON_MEMBERS(RecordingInfo::Event, time, severity, name, port, message)

namespace {

constexpr std::size_t kMaxEvents = 100;
constexpr std::uint64_t kInfoProgressEvery = 4096;
constexpr std::int64_t kGap_ns = 2'000'000'000;
constexpr double kGapPeriods = 10;

void tally(RecordingInfo::Port& port, double rate_Hz, Direction direction, std::int64_t at_ns, std::size_t bytes) {
  if (direction == Direction::sent) {
    ++port.sent;
    port.sent_bytes += bytes;
    return;
  }
  if (port.reads == 0) {
    port.first_ns = at_ns;
  } else {
    const std::int64_t gap = at_ns - port.last_ns;
    const auto periods = rate_Hz > 0 ? static_cast<std::int64_t>(kGapPeriods / rate_Hz * 1e9) : std::int64_t{0};
    port.longest_gap_ns = std::max(port.longest_gap_ns, gap);
    if (gap > std::max(kGap_ns, periods)) ++port.gaps;
  }
  port.last_ns = at_ns;
  ++port.reads;
  port.received_bytes += bytes;
}

void add_event(RecordingInfo& info, std::string_view text) {
  if (info.events.size() >= kMaxEvents) {
    ++info.further_events;
    return;
  }
  const auto json = FlatJson::parse(text);
  if (!json) return;
  info.events.push_back({std::string(json->get("time")), std::string(json->get("severity")),
                         std::string(json->get("name")), std::string(json->get("port")),
                         std::string(json->get("message"))});
}

void read_entries(Recording& recording, RecordingInfo& info, const Progress& progress) {
  const auto& settings = recording.settings().ports;
  for (const auto& port : settings) {
    auto& known = info.ports.emplace_back();
    known.name = port.name;
    known.protocol = protocols::name_of(port.protocol);
    known.baud = port.baud;
  }
  pipeline::UtcMapping mapping;
  std::uint64_t entries = 0;
  bool any = false;
  const auto at = [&](std::int64_t time_ns) {
    const std::int64_t utc_ns = mapping.to_utc(time_ns);
    if (!any) info.start_utc_ns = utc_ns;
    any = true;
    info.end_utc_ns = utc_ns;
  };
  while (const auto entry = recording.next()) {
    if (++entries % kInfoProgressEvery == 0) progress(recording.progress());
    if (const auto* read = std::get_if<RawRead>(&*entry)) {
      at(read->time_ns);
      tally(info.ports[read->port], settings[read->port].rate_Hz, read->direction, mapping.to_utc(read->time_ns),
            read->bytes.size());
    } else if (const auto* change = std::get_if<MappingChange>(&*entry)) {
      mapping = change->mapping;
    } else if (const auto* event = std::get_if<LoggedEvent>(&*entry)) {
      at(event->time_ns);
      add_event(info, event->json);
    }
  }
}

/// Counts every message, also those that a Recording leaves out, and finds damage.
void read_messages(LogReader& log, RecordingInfo& info, const Progress& progress) {
  std::uint64_t messages = 0;
  while (log.next()) {
    if (++messages % kInfoProgressEvery == 0) progress(log.progress());
  }
  for (const auto& [id, channel] : log.channels()) {
    if (channel.messages > 0) info.topics[channel.topic] = {channel.messages, channel.bytes};
  }
  const auto& findings = log.findings();
  info.finished = findings.finished;
  info.bad_crc = findings.bad_crc;
  info.damaged_bytes = findings.damaged_bytes;
  info.tail_bytes = findings.tail_bytes;
}

}  // namespace

RecordingInfo read_info(const std::filesystem::path& file, const Progress& progress) {
  RecordingInfo info;
  info.file = file.string();
  const auto recording = Recording::open(file);
  std::error_code ignored;
  info.bytes = std::filesystem::file_size(file, ignored);
  info.log = is_log(file);
  // Two passes for a log: one for what is replayed, one for everything.
  const double share = info.log ? 0.5 : 1.0;
  read_entries(*recording, info, [&](double done) { progress(done * share); });
  info.remarks = recording->remarks();
  if (info.log) {
    LogReader log(open_file(file), info.file);
    read_messages(log, info, [&](double done) { progress(share + done * share); });
  }
  progress(1.0);
  return info;
}

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
    auto& one = json["ports"].emplace_back();
    NAVCAL_PUT_MEMBERS(one, port, name, protocol, baud, reads, received_bytes, sent, sent_bytes);
    one["longest_gap_s"] = seconds(port.longest_gap_ns);
    one["gaps"] = port.gaps;
  }
  NAVCAL_PUT_MEMBERS(json, info, topics, events, further_events, bad_crc, damaged_bytes, tail_bytes, remarks);
  return json_text(json) + "\n";
}

}  // namespace navcal::record
