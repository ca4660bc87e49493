// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "config/complaints.h"
#include "config/described/description_file.h"
#include "config/log_choice.h"
#include "config/option_lookup.h"
#include "config/options.h"
#include "config/reader.h"
#include "config/text_rules.h"

namespace navcal::config {

namespace {

/// The entry of a key of the port, the last one where the command line says it again; nullptr: there is none.
const Entry* last_of(const std::vector<const Entry*>& entries, std::string_view key) {
  const Entry* last = nullptr;
  for (const Entry* entry : entries) {
    if (entry->keys.size() == 3 && entry->keys[2] == key) last = entry;
  }
  return last;
}

/// False when the value cannot be taken; take_port_entry() tells why.
bool holds(std::string_view key, PortSettings& port, const Entry* entry) {
  return entry == nullptr || !set(*find(port_options(), "", key), port, *entry);
}

/// Where a line of a description stands: in its file, or in the text within the configuration.
std::string place_of(const Problem& problem, const std::string& file) {
  const std::string key = problem.key.empty() ? "" : problem.key + ": ";
  return file.empty() ? fmt::format("line {}: {}{}", problem.line, key, problem.message)
                      : fmt::format("{}:{}: {}{}", file, problem.line, key, problem.message);
}

}  // namespace

void Reader::take_description(PortSettings& port, const std::vector<const Entry*>& entries) {
  const Entry* const device = last_of(entries, "device");
  const Entry* const description = last_of(entries, "description");
  const Entry* const adjust_entry = last_of(entries, "adjust");
  if (!holds("device", port, device) || !holds("description", port, description) ||
      !holds("adjust", port, adjust_entry))
    return;
  const Entry& at = description != nullptr ? *description : device != nullptr ? *device : *entries.front();
  if (device == nullptr && description == nullptr) {
    // A log that was made of a capture has none: nothing is found in the port's bytes.
    if (!folder_) return;
    problems_.push_back({at.line, at.name() + ".device", "missing; the file that describes the device"});
    return;
  }
  std::string file;
  if (description == nullptr) {
    if (!folder_)
      return complain(at, "the file is read together with a configuration file only; state description");
    const std::filesystem::path path = *folder_ / port.device;
    file = path.native();
    try {
      port.description = content_of(path);
    } catch (const Error& error) {
      return complain(at, error.problems().front());
    }
  }
  std::vector<Problem> problems;
  auto read = read_description(port.description, problems);
  for (const Problem& problem : problems) complain(at, place_of(problem, file));
  if (!problems.empty()) return;
  for (const std::string& adjustment : port.adjust) {
    if (auto wrong = adjust(read, adjustment)) complain(*adjust_entry, std::move(*wrong));
  }
  port.baud = read.baud.value_or(port.baud);
  port.rate_Hz = read.rate_Hz.value_or(port.rate_Hz);
  port.latency_s = read.latency_s.value_or(port.latency_s);
  port.latency_std_s = read.latency_std_s.value_or(port.latency_std_s);
  port.described = std::move(read);
}

// The tables [power.NAME], and what [log] leaves out: settings that name ports.
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
