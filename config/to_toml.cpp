// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "config/load.h"
#include "config/options.h"

namespace navcal::config {
namespace {

template <class Owner>
std::string line(const Option<Owner>& option, const Owner& owner) {
  return fmt::format("{} = {}\n", option.key, option.write(option.get(owner)));
}

std::string port_table(const PortSettings& port) {
  std::string out = fmt::format("\n[port.{}]\n", port.name);
  std::string_view table;
  for (const auto& option : port_options()) {
    if (!option.applies_to(port.protocol)) continue;
    const Value value = option.get(port);
    if (value == Value(std::string())) continue;  // a place that is not given
    if (option.table != table) {
      table = option.table;
      out += fmt::format("[port.{}.{}]\n", port.name, table);
    }
    out += line(option, port);
  }
  return out;
}

}  // namespace

std::string to_toml(const Settings& settings) {
  std::string out;
  std::string_view table;
  for (const auto& option : daemon_options()) {
    if (!option.moved_to.empty()) continue;
    if (option.table != table) {
      table = option.table;
      out += fmt::format("{}[{}]\n", out.empty() ? "" : "\n", table);
    }
    out += line(option, settings);
  }
  for (const auto& port : settings.ports) out += port_table(port);
  for (const auto& supply : settings.power) {
    out += fmt::format("\n[power.{}]\n", supply.name);
    for (const auto& option : power_options()) out += line(option, supply);
  }
  return out;
}

}  // namespace navcal::config
