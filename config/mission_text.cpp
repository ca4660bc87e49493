// SPDX-License-Identifier: Apache-2.0
#include "config/mission_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "config/mission_options.h"

namespace navcal::config {
namespace {

/// A value of a file, with four decimals at most.
std::string value_text(Value value) {
  if (auto* const number = std::get_if<double>(&value)) *number = std::round(*number * 1e4) / 1e4 + 0.0;
  return to_toml_text(value);
}

std::string step_text(const MissionStep& step) {
  std::string out;
  for (const Option<MissionStep>& option : step_options()) {
    const Value value = option.get(step);
    const bool is_said =
        option.key == "on" ? step.kind == StepKind::doublet : !std::holds_alternative<Unsupported>(value);
    if (is_said) out += fmt::format("{}{} = {}", out.empty() ? "{" : ", ", option.key, value_text(value));
  }
  return out + '}';
}

}  // namespace

std::string mission_text(const Mission& mission, std::string_view head) {
  std::string out;
  const auto at = std::back_inserter(out);
  while (!head.empty()) {
    const auto end = head.find('\n');
    fmt::format_to(at, "# {}\n", head.substr(0, end));
    head = end == std::string_view::npos ? std::string_view() : head.substr(end + 1);
  }
  for (const Option<Mission>& option : mission_options()) {
    const Value value = option.get(mission);
    if (value != Value(std::string())) fmt::format_to(at, "{} = {}\n", option.name(), value_text(value));
  }
  out += "\nstep = [\n";
  for (const MissionStep& step : mission.steps) fmt::format_to(at, "  {},\n", step_text(step));
  return out + "]\n";
}

}  // namespace navcal::config
