// SPDX-License-Identifier: Apache-2.0
// The tables [power.NAME], and what [log] leaves out: settings that name ports.
#include <fmt/format.h>

#include <algorithm>

#include "config/log_choice.h"
#include "config/option_lookup.h"
#include "config/options.h"
#include "config/reader.h"
#include "config/text_rules.h"

namespace navcal::config {

void Reader::take_power(const std::string& name, const std::vector<const Entry*>& entries) {
  const Entry& table = *entries.front();
  if (!is_port_name(name)) complain(table, "the name of a supply is 1 to 31 of a-z, 0-9, _ and -");
  if (table.keys.size() != 2 || !std::holds_alternative<Table>(table.value))
    return complain(table, "a table is expected");
  PowerSettings supply;
  supply.name = name;
  for (const Entry* entry : entries) {
    if (entry->keys.size() == 2) {
      if (entry != &table) complain(*entry, "a table is expected");
      continue;
    }
    const auto* option = entry->keys.size() == 3 ? find(power_options(), "", entry->keys[2]) : nullptr;
    if (option == nullptr) {
      // What lies below something wrong in a file has been complained of with that.
      if (entry->keys.size() == 3 || entry->line == 0)
        complain(*entry, "unknown key" + suggestion(entry->keys.back(), keys_of(power_options(), "")));
    } else if (auto refused = set(*option, supply, *entry)) {
      complain(*entry, std::move(*refused));
    }
  }
  settings_.power.push_back(std::move(supply));
  power_lines_.push_back(table.line);
}

void Reader::check_power() {
  for (std::size_t i = 0; i < settings_.power.size(); ++i) {
    const PowerSettings& supply = settings_.power[i];
    const auto problem = [&](std::string_view key, std::string message) {
      problems_.push_back({power_lines_[i], fmt::format("power.{}.{}", supply.name, key), std::move(message)});
    };
    if (supply.gpio_chip.empty()) problem("gpio_chip", "missing: the controller of the line");
    if (supply.line < 0) problem("line", "missing: the number of the line");
    if (supply.devices.empty()) problem("devices", "missing: the ports whose devices it feeds");
    for (const std::string& device : supply.devices) {
      const auto is_it = [&](const PortSettings& port) { return port.name == device; };
      if (std::none_of(settings_.ports.begin(), settings_.ports.end(), is_it))
        problem("devices", fmt::format("there is no port {}", device));
    }
    for (std::size_t j = 0; j < i; ++j) {
      const PowerSettings& other = settings_.power[j];
      if (supply.line >= 0 && supply.line == other.line && supply.gpio_chip == other.gpio_chip)
        problem("line", fmt::format("{} is already power.{}'s", supply.line, other.name));
      for (const std::string& device : supply.devices) {
        if (std::find(other.devices.begin(), other.devices.end(), device) != other.devices.end())
          problem("devices", fmt::format("power.{} feeds {} already", other.name, device));
      }
    }
  }
}

void Reader::check_log() {
  if (auto problem = problem_with_choice(settings_.log.leave_out, settings_.ports))
    problems_.push_back({leave_out_line_, "log.leave_out", std::move(*problem)});
}

}  // namespace navcal::config
