// SPDX-License-Identifier: Apache-2.0
#include "daemon/report_class.h"

#include <algorithm>

namespace navcal::daemon {
namespace {

constexpr std::array<std::string_view, kReportClasses> kReportClassNames{
    "TPV",   "SKY",    "ATT",   "MOTOR", "ALTIMETER", "NAV", "HEALTH", "TIME",   "LOG",
    "CALIB", "DEVICE", "STATE", "POWER", "BATTERY",   "DVL", "DEPTH",  "SENSOR", "RECORD"};

}  // namespace

std::string_view name_of(ReportClass report) { return kReportClassNames.at(static_cast<std::size_t>(report)); }

std::optional<ReportClass> report_class_named(std::string_view name) {
  for (std::size_t i = 0; i < kReportClasses; ++i) {
    if (kReportClassNames.at(i) == name) return static_cast<ReportClass>(i);
  }
  return std::nullopt;
}

std::string known_report_classes() {
  std::string names;
  for (const auto name : kReportClassNames) {
    if (!names.empty()) names += ", ";
    names += name;
  }
  return names;
}

ReportClasses ReportClasses::usual() {
  ReportClasses classes;
  for (std::size_t i = 0; i < kReportClasses; ++i) {
    const auto report = static_cast<ReportClass>(i);
    if (report != ReportClass::state && report != ReportClass::record) classes.add(report);
  }
  return classes;
}

bool ReportPacer::is_due(ReportClass report, std::uint16_t slot, std::int64_t interval_ns,
                         std::int64_t now_ns) const {
  for (const Next& next : next_) {
    if (next.report == report && next.slot == slot) return now_ns >= next.due_ns - interval_ns / 2;
  }
  return true;
}

bool ReportPacer::take(ReportClass report, std::uint16_t slot, std::int64_t interval_ns, std::int64_t now_ns) {
  if (!is_due(report, slot, interval_ns, now_ns)) return false;
  auto found = std::find_if(next_.begin(), next_.end(),
                            [&](const Next& next) { return next.report == report && next.slot == slot; });
  if (found == next_.end()) found = next_.insert(next_.end(), Next{report, slot, now_ns});
  found->due_ns = std::max(found->due_ns, now_ns - interval_ns / 2) + interval_ns;
  return true;
}

}  // namespace navcal::daemon
