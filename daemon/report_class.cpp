// SPDX-License-Identifier: Apache-2.0
#include "daemon/report_class.h"

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

}  // namespace navcal::daemon
