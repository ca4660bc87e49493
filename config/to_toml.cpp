// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "config/load.h"
#include "config/option_lookup.h"
#include "config/options.h"

namespace navcal::config {
namespace {

template <class Owner>
std::string line(const Option<Owner>& option, const Owner& owner) {
  return fmt::format("{} = {}\n", option.key, option.write(option.get(owner)));
}

bool is_given(const OptionInfo&, const Value& value) { return value != Value(std::string()); }

}  // namespace

std::string port_table(const PortSettings& port, bool (*states)(const OptionInfo&, const Value&)) {
  const auto heading = [&](std::string_view table) { return fmt::format("[port.{}.{}]\n", port.name, table); };
  return fmt::format("\n[port.{}]\n", port.name) + text_of(port_options(), heading, [&](const auto& option) {
           const bool is_stated = option.applies_to(port.protocol) && states(option, option.get(port));
           return is_stated ? line(option, port) : std::string();
         });
}

std::string to_toml(const Settings& settings) {
  const auto heading = [](std::string_view table) { return fmt::format("\n[{}]\n", table); };
  std::string out = text_of(daemon_options(), heading, [&](const auto& option) { return line(option, settings); });
  out.erase(0, 1);  // no empty line at the beginning
  for (const auto& port : settings.ports) out += port_table(port, is_given);
  for (const auto& supply : settings.power) {
    out += fmt::format("\n[power.{}]\n", supply.name);
    for (const auto& option : power_options()) out += line(option, supply);
  }
  return out;
}

}  // namespace navcal::config
