// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/report.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace navcal::calib {

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::shadow:
      return "shadow";
    case Verdict::in_force:
      return "in_force";
    case Verdict::refused:
      break;
  }
  return "refused";
}

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::accepted:
      return "accepted";
    case Outcome::no_better:
      return "no better";
    case Outcome::refused:
      break;
  }
  return "refused";
}

std::string utc_text(std::int64_t utc_ns) {
  if (utc_ns == 0) return "an unknown time";
  const std::chrono::sys_time<std::chrono::nanoseconds> utc{std::chrono::nanoseconds(utc_ns)};
  const auto day = std::chrono::floor<std::chrono::days>(utc);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss time(std::chrono::floor<std::chrono::milliseconds>(utc - day));
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(time.hours().count()), static_cast<int>(time.minutes().count()),
                static_cast<int>(time.seconds().count()), static_cast<int>(time.subseconds().count()));
  return text.data();
}

std::string words_of(const FieldStep& step) {
  const auto& size = step.size_uT;
  const auto& error = step.std_uT;
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "the field stepped by (%.2f, %.2f, %.2f) +- (%.2f, %.2f, %.2f) uT at ",
                size.x(), size.y(), size.z(), error.x(), error.y(), error.z());
  return text.data() + utc_text(step.utc_ns) + (step.returned ? ", back to the field before" : "");
}

const Quantity* CalibratorReport::quantity(std::string_view name) const {
  const auto found =
      std::find_if(estimate.begin(), estimate.end(), [&](const Quantity& q) { return q.name == name; });
  return found == estimate.end() ? nullptr : &*found;
}

const CalibratorReport* Report::find(Calibrator calibrator) const {
  const auto found = std::find_if(calibrators.begin(), calibrators.end(),
                                  [&](const CalibratorReport& report) { return report.calibrator == calibrator; });
  return found == calibrators.end() ? nullptr : &*found;
}

}  // namespace navcal::calib
