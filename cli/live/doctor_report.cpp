// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/enum_name.h"
#include "cli/live/doctor_checks.h"

namespace navcal::cli {
namespace {

std::string_view word_of(Finding::Severity severity) {
  return base::enum_name<Finding::Severity::fault>(severity, {"ok", "warning", "fault"});
}

std::string number_of(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

std::size_t count_of(const Findings& findings, Finding::Severity severity) {
  return static_cast<std::size_t>(
      std::ranges::count_if(findings, [&](const Finding& finding) { return finding.severity == severity; }));
}

std::string doctor_text(const Findings& findings) {
  std::size_t width = 0;
  for (const Finding& finding : findings) width = std::max(width, finding.topic.size());
  std::string out;
  const auto append = [&](auto&&... arguments) {
    fmt::format_to(std::back_inserter(out), std::forward<decltype(arguments)>(arguments)...);
  };
  for (const Finding& finding : findings) {
    append(fmt::runtime("{:<8} {:<{}}  {}\n"), word_of(finding.severity), finding.topic, width, finding.found);
    if (!finding.mend.empty()) append(fmt::runtime("{:{}}  -> {}\n"), "", width + 9, finding.mend);
  }
  const auto faults = count_of(findings, Finding::Severity::fault);
  const auto warnings = count_of(findings, Finding::Severity::warning);
  if (faults + warnings == 0) {
    out += "No faults and no warnings.\n";
  } else {
    append(fmt::runtime("{}, {}.\n"), number_of(faults, "fault"), number_of(warnings, "warning"));
  }
  return out;
}

std::string doctor_json(const Findings& findings, const std::string& account, const std::string& configuration) {
  using OrderedJson = nlohmann::ordered_json;
  OrderedJson list = OrderedJson::array();
  for (const Finding& finding : findings) {
    list.push_back({{"severity", word_of(finding.severity)},
                    {"topic", finding.topic},
                    {"found", finding.found},
                    {"mend", finding.mend.empty() ? OrderedJson(nullptr) : OrderedJson(finding.mend)}});
  }
  const OrderedJson all{{"class", "DOCTOR"},
                        {"account", account},
                        {"configuration", configuration},
                        {"findings", list},
                        {"faults", count_of(findings, Finding::Severity::fault)},
                        {"warnings", count_of(findings, Finding::Severity::warning)}};
  return all.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace navcal::cli
