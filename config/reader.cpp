// SPDX-License-Identifier: Apache-2.0
#include "config/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "config/load.h"
#include "config/option_lookup.h"
#include "config/options.h"
#include "config/text_rules.h"

namespace navcal::config {
namespace {

constexpr std::string_view kPort = "port";
constexpr std::string_view kPower = "power";

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_place(std::string_view key) {
  return key == "path" || key == "udev_name" || key == "usb_serial" || key == "address";
}

}  // namespace

void Reader::complain(const Entry& entry, std::string message) {
  problems_.push_back({entry.line, entry.name(), std::move(message)});
}

void Reader::collect(NamedTables& tables, const Entry& entry) {
  const std::string& kind = entry.keys.front();
  if (entry.keys.size() == 1) {
    if (!std::holds_alternative<Table>(entry.value))
      complain(entry, fmt::format("tables [{}.NAME] are expected", kind));
    return;
  }
  const std::string& name = entry.keys[1];
  auto table = std::find_if(tables.begin(), tables.end(), [&](const auto& known) { return known.first == name; });
  if (table == tables.end()) {
    if (entry.line == 0) {
      std::vector<std::string> names;
      names.reserve(tables.size());
      for (const auto& known : tables) names.push_back(known.first);
      complain(entry, fmt::format("the file has no {} of this name", kind) + suggestion(name, names));
      return;
    }
    table = tables.insert(tables.end(), {name, {}});
  }
  table->second.push_back(&entry);
}

void Reader::take(const std::vector<Entry>& entries) {
  NamedTables ports, supplies;
  for (const Entry& entry : entries) {
    if (entry.keys.front() == kPort) {
      collect(ports, entry);
    } else if (entry.keys.front() == kPower) {
      collect(supplies, entry);
    } else {
      take_daemon(entry);
    }
  }
  for (const auto& [name, own_entries] : ports) take_port(name, own_entries);
  for (const auto& [name, own_entries] : supplies) take_power(name, own_entries);
}

void Reader::take_daemon(const Entry& entry) {
  if (auto refused = take_entry(daemon_options(), settings_, entry, {std::string(kPort), std::string(kPower)}))
    complain(entry, std::move(*refused));
  if (entry.name() == "log.leave_out") leave_out_line_ = entry.line;
  if (entry.keys.front() == "remote") remote_line_ = entry.line;
  if (entry.keys.front() == "command" && entry.keys.size() == 2) command_lines_[entry.keys[1]] = entry.line;
  if (entry.keys.front() != "roles" || entry.keys.size() != 2) return;
  for (const Role role : kRoles) {
    if (entry.keys[1] == name_of(role)) role_lines_.at(static_cast<std::size_t>(role)) = entry.line;
  }
}

void Reader::take_port(const std::string& name, const std::vector<const Entry*>& entries) {
  const Entry& table = *entries.front();
  if (!is_port_name(name)) complain(table, "a port's name is 1 to 31 of a-z, 0-9, _ and -");
  if (table.keys.size() != 2 || !std::holds_alternative<Table>(table.value)) {
    complain(table, "a table is expected");
    return;
  }
  // Everything else of a port starts from what is usual for its protocol, so that comes first.
  const Option<PortSettings>& protocol = port_options().front();
  PortSettings given;
  const Entry* said = nullptr;
  for (const Entry* entry : entries) {
    if (entry->keys.size() == 3 && entry->keys[2] == protocol.key) said = entry;
  }
  bool protocol_known = false;
  if (said == nullptr) {
    problems_.push_back({table.line, table.name() + ".protocol", "missing; known: " + protocol.allowed()});
  } else if (auto refused = set(protocol, given, *said)) {
    complain(*said, std::move(*refused));
  } else {
    protocol_known = true;
  }
  PortSettings port = default_port(name, given.protocol, default_baud(given.protocol));
  if (protocol_known && given.protocol == protocols::Protocol::described) take_description(port, entries);
  for (const Entry* entry : entries) {
    if (entry->keys.size() > 2) {
      take_port_entry(port, *entry, protocol_known);
    } else if (entry != &table) {
      complain(*entry, "a table is expected");
    }
  }
  settings_.ports.push_back(std::move(port));
  port_lines_.push_back(table.line);
}

void Reader::take_port_entry(PortSettings& port, const Entry& entry, bool protocol_known) {
  const auto& options = port_options();
  const std::string& key = entry.keys[2];
  const auto tables = tables_of(options);
  if (key == options.front().key && entry.keys.size() == 3) return;  // the protocol was taken first
  const bool in_table = contains(tables, key);
  if (in_table && entry.keys.size() == 3) {
    if (!std::holds_alternative<Table>(entry.value)) complain(entry, "a table is expected");
    return;
  }
  const auto* option = in_table ? find(options, key, entry.keys[3]) : find(options, "", key);
  if (entry.keys.size() > (in_table ? 4U : 3U)) {
    // Below something that has been complained of already, unless it came alone.
    if (entry.line == 0) complain(entry, "unknown key");
    return;
  }
  if (option == nullptr) {
    auto known = keys_of(options, in_table ? key : "");
    if (!in_table) known.insert(known.end(), tables.begin(), tables.end());
    complain(entry, "unknown key" + suggestion(entry.keys.back(), known));
    return;
  }
  if (protocol_known && !option->applies_to(port.protocol)) {
    complain(entry, fmt::format("a port of protocol {} has no such setting", protocols::name_of(port.protocol)));
    return;
  }
  if (entry.line == 0 && is_place(key)) port.path = port.udev_name = port.usb_serial = port.address = "";
  if (auto refused = set(*option, port, entry)) complain(entry, std::move(*refused));
}

void Reader::check_ports() {
  if (settings_.ports.empty()) {
    problems_.push_back(
        {1, "port", "no port is configured; a port is a table [port.NAME] with a protocol and a path"});
  }
  constexpr std::size_t kMostPorts = 256;
  if (settings_.ports.size() > kMostPorts) {
    problems_.push_back(
        {1, "port", fmt::format("{} ports are configured; {} is the most", settings_.ports.size(), kMostPorts)});
  }
  for (std::size_t i = 0; i < settings_.ports.size(); ++i) {
    const PortSettings& port = settings_.ports[i];
    const std::string key = "port." + port.name;
    const int places = int{!port.path.empty()} + int{!port.udev_name.empty()} + int{!port.usb_serial.empty()} +
                       int{!port.address.empty()};
    if (places == 0)
      problems_.push_back({port_lines_[i], key, "the place is missing: path, udev_name, usb_serial or address"});
    if (places > 1)
      problems_.push_back(
          {port_lines_[i], key, "only one of path, udev_name, usb_serial and address may be given"});
    for (std::size_t j = 0; j < i; ++j) {
      const PortSettings& other = settings_.ports[j];
      const auto same = [&](std::string_view what, const std::string& mine, const std::string& others) {
        if (mine.empty() || mine != others) return;
        problems_.push_back({port_lines_[i], fmt::format("{}.{}", key, what),
                             fmt::format("{} is already port.{}'s (line {})", mine, other.name, port_lines_[j])});
      };
      same("path", port.path, other.path);
      same("udev_name", port.udev_name, other.udev_name);
      same("usb_serial", port.usb_serial, other.usb_serial);
      same("address", port.address, other.address);
      if (port.protocol == other.protocol) same("serial_number", port.serial_number, other.serial_number);
    }
  }
}

void Reader::check_instruments(const std::vector<Entry>& entries) {
  const auto in_file = [&](std::string_view name) {
    return std::find_if(entries.begin(), entries.end(),
                        [&](const Entry& entry) { return entry.line != 0 && entry.name() == name; });
  };
  for (const auto& option : daemon_options()) {
    if (option.moved_to.empty()) continue;
    const auto old = in_file(option.name()), now = in_file(option.moved_to);
    if (old == entries.end() || now == entries.end()) continue;
    complain(*old, fmt::format("this is {} now, which is stated too (line {})", option.moved_to, now->line));
  }
  const GpsAccuracy& gps = settings_.instruments.gps;
  if (gps.least_search_s <= gps.longest_search_s) return;
  constexpr std::string_view kLongest = "instruments.gps_longest_search_s";
  auto stated = in_file(kLongest);
  if (stated == entries.end()) stated = in_file("instruments.gps_least_search_s");
  problems_.push_back(
      {stated == entries.end() ? 0 : stated->line, std::string(kLongest),
       fmt::format("{} s is less than the shortest, {} s", gps.longest_search_s, gps.least_search_s)});
}

void Reader::check_roles() {
  std::vector<std::string> names;
  for (const PortSettings& port : settings_.ports) names.push_back(port.name);
  for (const Role role : kRoles) {
    const std::string& name = settings_.roles.port_name(role);
    if (name.empty()) continue;
    const auto problem = [&](std::string message) {
      problems_.push_back({role_lines_.at(static_cast<std::size_t>(role)), fmt::format("roles.{}", name_of(role)),
                           std::move(message)});
    };
    const auto port = std::ranges::find(settings_.ports, name, &PortSettings::name);
    if (port == settings_.ports.end()) {
      problem(fmt::format("there is no port {}", name) + suggestion(name, names));
    } else if (!can_deliver(*port, role)) {
      problem(port->described ? fmt::format("port {} is of a described device, and {} has no {}", name,
                                            port->device.empty() ? "its description" : port->device, name_of(role))
                              : fmt::format("port {} is of protocol {}, which has no {}", name,
                                            protocols::name_of(port->protocol), name_of(role)));
    }
  }
}

void Reader::check_command() {
  const CommandSettings& command = settings_.command;
  // A limit of the file may contradict a default: then the one that was given is named.
  const auto problem = [&](const char* key, const char* limit, std::string message) {
    const bool is_given = command_lines_.contains(key);
    const auto line = command_lines_.find(is_given ? key : limit);
    problems_.push_back({line != command_lines_.end() ? line->second : 1,
                         fmt::format("command.{}", is_given ? key : limit), std::move(message)});
  };
  if (command.min_timeout_s > command.max_timeout_s)
    problem("min_timeout_s", "max_timeout_s",
            fmt::format("min_timeout_s {} is more than max_timeout_s {}", command.min_timeout_s,
                        command.max_timeout_s));
  if (std::abs(command.safe_rpm) > command.max_rpm)
    problem("safe_rpm", "max_rpm",
            fmt::format("safe_rpm {} is beyond max_rpm {}", command.safe_rpm, command.max_rpm));
  for (const double fin_deg : command.safe_fins_deg) {
    if (std::abs(fin_deg) <= command.max_fin_deg) continue;
    problem("safe_fins_deg", "max_fin_deg",
            fmt::format("safe_fins_deg {} is beyond max_fin_deg {}", fin_deg, command.max_fin_deg));
    break;
  }
}

void Reader::check_remote() {
  if (settings_.remote.path.empty() || settings_.remote.listen.empty()) return;
  problems_.push_back({remote_line_, "remote.listen", "path and listen are given: the link has one line"});
}

}  // namespace navcal::config
