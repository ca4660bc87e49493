// SPDX-License-Identifier: Apache-2.0
#include "config/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "config/load.h"
#include "config/option_lookup.h"
#include "config/options.h"
#include "protocols/device_types.h"

namespace navcal::config {
namespace {

using protocols::Protocol;

/// One of path, udev_name, usb_serial and address.
bool is_place(const OptionInfo& option) {
  return option.table.empty() && (option.key == "path" || option.key == "udev_name" ||
                                  option.key == "usb_serial" || option.key == "address");
}

/// Empty when there is no default.
std::string default_words(const Option<Settings>& option) { return option.write(option.get(Settings{})); }

/// One value when all protocols that have the option agree on it, else each protocol's.
std::string default_words(const Option<PortSettings>& option) {
  if (is_place(option)) return "none: one of path, udev_name, usb_serial, address is required";
  if (option.key == "protocol") return {};
  std::vector<std::string> each;
  std::string first;
  bool all_equal = true;
  for (const protocols::DeviceType& device : protocols::kDeviceTypes) {
    if (!option.applies_to(device.protocol)) continue;
    const std::string value = option.write(option.get(default_port("", device.protocol, device.baud)));
    if (each.empty()) first = value;
    all_equal = all_equal && value == first;
    each.push_back(fmt::format("{} {}", device.name, value));
  }
  return all_equal ? first : fmt::format("{}", fmt::join(each, ", "));
}

/// Empty when it has to be given.
std::string default_words(const Option<PowerSettings>& option) {
  const bool is_required = option.key == "gpio_chip" || option.key == "line" || option.key == "devices";
  return is_required ? std::string() : option.write(option.get(PowerSettings{}));
}

/// The protocols whose ports have one of the options of a table.
template <class Owner>
std::string protocols_words(const std::vector<Option<Owner>>& options, std::string_view table) {
  std::vector<std::string_view> names;
  for (const protocols::DeviceType& device : protocols::kDeviceTypes) {
    const auto has = [&](const Option<Owner>& option) {
      return option.table == table && option.applies_to(device.protocol);
    };
    if (std::any_of(options.begin(), options.end(), has)) names.push_back(device.name);
  }
  return fmt::format("{}", fmt::join(names, names.size() > 2 ? ", " : " and "));
}

std::string default_clause(const OptionInfo& option, const std::string& words) {
  if (is_place(option)) return "one of path, udev_name, usb_serial and address is required";
  return words.empty() ? "required" : "default: " + words;
}

std::string daemon_part() {
  const auto heading = [](std::string_view table) {
    return fmt::format("\n# {}\n[{}]\n", option_text(table), table);
  };
  return text_of(daemon_options(), heading, [](const auto& option) {
    const std::string words = default_words(option);
    return fmt::format("\n# {}\n# {}; {}\n{} = {}\n", option.description, option.allowed(),
                       default_clause(option, words), option.key, words);
  });
}

/// An option of a port or a supply, all of it comment.
template <class Owner>
std::string explained(const Option<Owner>& option) {
  return fmt::format("#   {:<16} {}\n#   {:<16} {}; {}\n", option.key, option.description, "", option.allowed(),
                     default_clause(option, default_words(option)));
}

/// Every option of a port, explained once.
std::string port_part() {
  const auto heading = [](std::string_view table) {
    return fmt::format("#\n# {} (for {})\n# [port.NAME.{}]\n", option_text(table),
                       protocols_words(port_options(), table), table);
  };
  return fmt::format("\n# {}\n#\n# [port.NAME]\n", option_text(kUntitled<PortSettings>)) +
         text_of(port_options(), heading, explained<PortSettings>);
}

/// Every option of a supply.
std::string power_part() {
  const auto heading = [](std::string_view) { return std::string(); };
  return fmt::format("\n# {}\n#\n# [power.NAME]\n", option_text(kUntitled<PowerSettings>)) +
         text_of(power_options(), heading, explained<PowerSettings>);
}

/// Whether an option belongs to the wiring of the vehicle or to the single device.
bool is_of_vehicle(const OptionInfo& option, const Value&) {
  return !option.table.empty() || option.key == "protocol" || option.key == "udev_name" || option.key == "baud" ||
         option.key == "latency_ms" || option.key == "rate_Hz";
}

template <class Owner>
std::string markdown(const std::vector<Option<Owner>>& options, std::string_view prefix) {
  std::string out;
  std::string_view table = "none yet";
  for (const auto& option : options) {
    if (!option.moved_to.empty()) continue;
    if (option.table != table) {
      table = option.table;
      const std::string_view dot = prefix.empty() || table.empty() ? "" : ".";
      out += fmt::format("\n### `[{}{}{}]`\n\n{}", prefix, dot, table,
                         option_text(table.empty() ? kUntitled<Owner> : table));
      if (!option.only_for.empty()) out += fmt::format(" For {} only.", protocols_words(options, table));
      out += "\n\n| key | what | allowed | default |\n|---|---|---|---|\n";
    }
    const std::string words = default_words(option);
    out += fmt::format("| `{}` | {} | {} | {} |\n", option.key, option.description, option.allowed(),
                       words.empty() ? default_clause(option, words) : words);
  }
  return out;
}

}  // namespace

Settings shipped_settings() {
  Settings settings;
  for (const protocols::DeviceType& device : protocols::kDeviceTypes) {
    if (device.vehicle.name.empty()) continue;
    PortSettings port = default_port(std::string(device.vehicle.name), device.protocol, device.vehicle.baud);
    port.udev_name = "/dev/navcal/" + port.name;
    settings.ports.push_back(std::move(port));
  }
  return settings;
}

std::string shipped_file() {
  std::string out =
      "# The settings of navcald. A setting that is not given has the default stated beside it; a key that "
      "navcald does\n"
      "# not know is an error. `navcald --config FILE --check` reads a file and reports its mistakes.\n"
      "# This file is written from the program's own table of options: docs/configuration.md.\n";
  out += daemon_part();
  out += port_part();
  out += power_part();
  out += "\n# The instruments of the reference vehicle.\n";
  for (const PortSettings& port : shipped_settings().ports) out += port_table(port, is_of_vehicle);
  return out;
}

std::string with_option_tables(std::string_view page) {
  constexpr std::string_view kBegin = "<!-- options: begin -->\n";
  constexpr std::string_view kEnd = "<!-- options: end -->";
  const std::size_t begin = page.find(kBegin);
  const std::size_t end = page.find(kEnd);
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) return std::string(page);
  std::string out(page.substr(0, begin + kBegin.size()));
  out += markdown(daemon_options(), "");
  out += markdown(port_options(), "port.NAME");
  out += markdown(power_options(), "power.NAME");
  out += '\n';
  return out += page.substr(end);
}

}  // namespace navcal::config
