// SPDX-License-Identifier: Apache-2.0
#include "config/log_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/text_rules.h"

namespace navcal::config {

bool is_log_choice(std::string_view text) {
  if (text.starts_with(kRawChoice)) return is_port_name(text.substr(kRawChoice.size()));
  return std::find(kLogGroups.begin(), kLogGroups.end(), text) != kLogGroups.end();
}

std::optional<std::string> problem_with_choice(const std::vector<std::string>& leave_out,
                                               const std::vector<PortSettings>& ports) {
  if (leave_out.size() > kMostChoices)
    return fmt::format("at most {} can be left out; raw is all ports", kMostChoices);
  for (const std::string& choice : leave_out) {
    if (!is_log_choice(choice))
      return fmt::format("{} cannot be left out; what can: {}, and raw.NAME of a port", choice,
                         fmt::join(kLogGroups, ", "));
    if (!choice.starts_with(kRawChoice)) continue;
    const std::string name = choice.substr(kRawChoice.size());
    const auto is_it = [&](const PortSettings& port) { return port.name == name; };
    if (std::none_of(ports.begin(), ports.end(), is_it)) return fmt::format("there is no port {}", name);
  }
  return std::nullopt;
}

}  // namespace navcal::config
