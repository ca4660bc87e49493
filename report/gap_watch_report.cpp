// SPDX-License-Identifier: Apache-2.0
#include "report/gap_watch_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/enum_name.h"
#include "report/where_json.h"

namespace navcal::report {
namespace {

using EventJson = nlohmann::ordered_json;

double seconds(std::int64_t time_ns) { return 1e-3 * static_cast<double>(std::int64_t{time_ns / 1'000'000}); }

std::string_view event_name(gap::WatchEvent::Kind kind) {
  return base::enum_name<gap::WatchEvent::Kind::unknown>(kind, {"status", "skipped", "alarm", "cause", "unknown"});
}

EventJson list_of_causes(const gap::WatchReport& report) {
  EventJson list = EventJson::array();
  for (const gap::WatchReport::Cause& cause : report.causes) {
    list.push_back({{"name", cause.effect},
                    {"probability", std::min(1.0, cause.probability)},
                    {"strength", cause.strength},
                    {"since", seconds(cause.since_ns)}});
  }
  return list;
}

}  // namespace

std::string watch_began_json(const WatchStart& start) {
  EventJson json{{"event", "began"}, {"vehicle", start.vehicle}, {"source", start.source}};
  json["window_s"] = gap::kWindow_s;
  NAVCAL_PUT_MEMBERS(json, start, false_alarms_per_h, threshold_nats);
  json["reference"] = {{"missions", start.reference_missions}, {"windows", start.reference_windows}};
  json["restored_windows"] = start.restored_windows;
  if (!start.state_refused.empty()) json["state_refused"] = start.state_refused;
  return json.dump(-1, ' ', false, EventJson::error_handler_t::replace);
}

std::string watch_event_json(const gap::WatchEvent& event, const gap::WatchReport& report) {
  EventJson json{{"event", event_name(event.kind)}, {"time", seconds(event.time_ns)}};
  if (event.kind == gap::WatchEvent::Kind::skipped) json["reason"] = event.reason;
  json["verdict"] = gap::name_of(report.verdict);
  NAVCAL_PUT_MEMBERS(json, report, windows, skipped, evidence_nats, threshold_nats);
  if (report.alarm_ns) {
    json["alarm"] = seconds(*report.alarm_ns);
    json["effects"] = list_of_causes(report);
    json["where"] = report.where;
    json["unexplained"] = nullptr;
    if (!report.unexplained.empty()) json["unexplained"] = report.unexplained;
  }
  return json.dump(-1, ' ', false, EventJson::error_handler_t::replace);
}

std::string watch_notice_json(std::string_view event, std::string_view reason) {
  EventJson json{{"event", event}};
  if (!reason.empty()) json["reason"] = reason;
  return json.dump(-1, ' ', false, EventJson::error_handler_t::replace);
}

std::string watch_metrics(const gap::WatchReport& report) {
  std::string text;
  const auto add = [&](std::string_view name, std::string_view type, std::string_view help, double value) {
    fmt::format_to(std::back_inserter(text), "# HELP {0} {2}\n# TYPE {0} {1}\n{0} {3}\n", name, type, help, value);
  };
  add("navcal_gap_watch_windows_total", "counter", "Windows of the mission that were judged.",
      static_cast<double>(report.windows));
  add("navcal_gap_watch_skipped_total", "counter", "Windows of the mission that could not be judged.",
      static_cast<double>(report.skipped));
  add("navcal_gap_watch_evidence_nats", "gauge", "Logarithm of the test's statistic.", report.evidence_nats);
  add("navcal_gap_watch_threshold_nats", "gauge", "Statistic from which the alarm is raised.",
      report.threshold_nats);
  add("navcal_gap_watch_alarm", "gauge", "1 while an alarm stands.", report.alarm_ns ? 1 : 0);
  return text;
}

}  // namespace navcal::report
