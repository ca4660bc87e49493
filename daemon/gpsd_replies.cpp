// SPDX-License-Identifier: Apache-2.0
#include "daemon/gpsd_replies.h"

#include <fmt/format.h>

#include <iterator>

#include "daemon/json_text.h"
#include "record/log/log_topics.h"

namespace navcal::daemon {
namespace {

constexpr int kSeenGps = 1;  ///< gpsd's flag for a device that has delivered positions
constexpr std::string_view boolean(bool value) { return value ? "true" : "false"; }

void append_rates(std::string& out, const ReportIntervals& intervals_ns) {
  std::string_view separator = ",\"rate_Hz\":{";
  for (std::size_t i = 0; i < kReportClasses; ++i) {
    const std::int64_t interval_ns = intervals_ns.at(i);
    if (interval_ns == 0) continue;
    fmt::format_to(std::back_inserter(out), FMT_STRING("{}\"{}\":"), separator,
                   name_of(static_cast<ReportClass>(i)));
    append_shortest(out, 1e9 / static_cast<double>(interval_ns), 3);
    separator = ",";
  }
  if (separator == ",") out += '}';
}

void append_topic_rates(std::string& out, const RecordIntervals& intervals_ns) {
  const auto chosen = intervals_ns.chosen();
  if (chosen.empty()) return;
  std::string_view separator = ",\"topic_rate_Hz\":{";
  for (const auto& [topic, interval_ns] : chosen) {
    fmt::format_to(std::back_inserter(out), FMT_STRING("{}\"{}\":"), separator, topic);
    if (interval_ns == 0) {
      out += "null";
    } else {
      append_shortest(out, 1e9 / static_cast<double>(interval_ns), 3);
    }
    separator = ",";
  }
  out += '}';
}

}  // namespace

void append_version(std::string& out) {
  fmt::format_to(
      std::back_inserter(out),
      FMT_STRING(R"({{"class":"VERSION","release":"3.22","rev":"navcal {}","proto_major":{},"proto_minor":{}}})"
                 "\r\n"),
      NAVCAL_VERSION, kProtocolMajor, kProtocolMinor);
}

void append_device_object(std::string& out, const DeviceState& device) {
  out += R"({"class":"DEVICE","path":)";
  append_quoted(out, device.name);
  out += ",\"driver\":";
  append_quoted(out, device.driver);
  if (device.activated_utc_ns) {
    out += ",\"activated\":";
    append_utc(out, *device.activated_utc_ns, 3);
    out += ",\"tty\":";
    append_quoted(out, device.tty);
  }
  fmt::format_to(std::back_inserter(out),
                 FMT_STRING(",\"flags\":{},\"native\":0,\"bps\":{},\"parity\":\"N\",\"stopbits\":1"),
                 device.gps ? kSeenGps : 0, device.baud);
  out += ",\"cycle\":";
  append_fixed(out, device.cycle_s, 3);
  out += '}';
}

void append_watch(std::string& out, const WatchPolicy& policy) {
  fmt::format_to(
      std::back_inserter(out),
      FMT_STRING(R"({{"class":"WATCH","enable":{},"json":{},"nmea":{},"raw":0,"scaled":false,"timing":false,)"
                 R"("split24":false,"pps":false)"),
      boolean(policy.enable), boolean(policy.json), boolean(policy.nmea));
  if (policy.device) {
    out += ",\"device\":";
    append_quoted(out, *policy.device);
  }
  if (policy.classes != ReportClasses::usual()) {
    std::string_view separator = ",\"classes\":[";
    for (std::size_t i = 0; i < kReportClasses; ++i) {
      const auto report = static_cast<ReportClass>(i);
      if (!policy.classes.has(report)) continue;
      fmt::format_to(std::back_inserter(out), FMT_STRING("{}\"{}\""), separator, name_of(report));
      separator = ",";
    }
    out += separator == "," ? "]" : ",\"classes\":[]";
  }
  append_rates(out, policy.intervals_ns);
  if (policy.nmea_interval_ns != kNmeaInterval_ns) {
    out += ",\"nmea_rate_Hz\":";
    append_shortest(out, 1e9 / static_cast<double>(policy.nmea_interval_ns), 3);
  }
  if (policy.topics != RecordTopics::all()) {
    out += ",\"topics\":[";
    append_quoted_list(out, policy.topics.names());
    out += ']';
  }
  append_topic_rates(out, policy.topic_intervals_ns);
  out += "}\r\n";
}

void append_records(std::string& out) {
  // 60 kB of schemas: built once.
  static const std::string kAnswer = [] {
    std::string answer;
    std::string_view separator = R"({"class":"RECORDS","topics":[)";
    for (const record::Topic& topic : record::json_topics()) {
      if (!RecordTopics::all().has(topic.id)) continue;
      fmt::format_to(std::back_inserter(answer),
                     FMT_STRING(R"({}{{"topic":"{}","schema_name":"{}","schema":{}}})"), separator, topic.name,
                     topic.schema_name, record::json_schema(topic));
      separator = ",";
    }
    return answer + "]}\r\n";
  }();
  out += kAnswer;
}

void append_error(std::string& out, std::string_view message) {
  out += R"({"class":"ERROR","message":)";
  append_quoted(out, message);
  out += "}\r\n";
}

}  // namespace navcal::daemon
