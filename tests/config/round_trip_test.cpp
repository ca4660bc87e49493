// SPDX-License-Identifier: Apache-2.0
// parse(to_toml(s)) == s, for settings drawn at random over the whole range of every option.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "config/described/description_file.h"
#include "config/load.h"
#include "config/log_choice.h"
#include "config/options.h"

namespace navcal::config {
namespace {

using Random = std::mt19937_64;

double number_within(const OptionInfo& option, Random& random) {
  if (random() % 8 == 0) return option.low;
  if (random() % 8 == 0) return option.high;
  double number = std::uniform_real_distribution<double>(option.low, option.high)(random);
  // Numbers that people write, and numbers with all their bits.
  if (random() % 2 == 0) number = std::clamp(std::round(number * 100) / 100, option.low, option.high);
  return number == 0 && !option.zero_allowed ? option.high : number;
}

std::string some_text(const OptionInfo& option, Random& random) {
  if (option.key == "address") return random() % 2 == 0 ? "0.0.0.0" : "::1";
  if (option.table == "remote" && option.key == "listen") return random() % 2 == 0 ? "" : "[::1]:2950";
  if (option.key == "id") return random() % 2 == 0 ? "" : "AUV-2.b_9";
  if (option.key == "rollover_pivot")
    return fmt::format("{}-{:02}-{:02}", 1981 + random() % 90, 1 + random() % 12, 1 + random() % 28);
  constexpr std::string_view kPieces[] = {
      "a", "Z", "0", "/", " ", "\"", "\\", "'", "#", "=", ".", "\xc3\xa9", "\xf0\x9f\x90\x9f", "[", "}"};
  std::string text = "/";
  for (auto n = random() % 14; n > 0; --n) text += kPieces[random() % std::size(kPieces)];
  return text;
}

Value some_value(const OptionInfo& option, Random& random) {
  switch (option.kind) {
    case Kind::boolean: return random() % 2 == 0;
    case Kind::integer: return static_cast<std::int64_t>(number_within(option, random));
    case Kind::real: return number_within(option, random);
    case Kind::text: return some_text(option, random);
    case Kind::choice: return std::string(option.choices[random() % option.choices.size()]);
    case Kind::list: {
      std::vector<std::string> some;  // those of the log: the only list outside the supplies
      for (const auto group : kLogGroups) {
        if (random() % 3 == 0) some.emplace_back(group);
      }
      return some;
    }
    case Kind::channels: break;
  }
  std::vector<double> numbers(option.count);
  for (double& number : numbers) number = number_within(option, random);
  return numbers;
}

/// A file that is not there any more, with its text, and a zero of the single device.
void describe(PortSettings& port) {
  port.device = "no/such/file.toml";
  port.description =
      "# \"quotes\" and \\\nform = \"text\"\n[[frame]]\nid = \"D\"\nstart = \"D,\"\nchecksum = \"none\"\n"
      "field = [{ meaning = \"depth\", number = 1, unit = \"m\" }]\n";
  port.adjust = {"depth: zero = 0.25"};
  port.described = parse_description(port.description, "test");
  ASSERT_EQ(adjust(*port.described, port.adjust.front()), std::nullopt);
}

PortSettings some_port(std::size_t index, Random& random) {
  const auto& options = port_options();
  PortSettings port;
  options.front().set(port, some_value(options.front(), random));
  port = default_port(fmt::format("p{}", index), port.protocol, default_baud(port.protocol));
  const auto place = random() % 4;
  std::size_t places = 0;
  if (port.protocol == protocols::Protocol::described) describe(port);
  for (const auto& option : options) {
    if (option.key == "protocol" || !option.applies_to(port.protocol)) continue;
    if (option.key == "device" || option.key == "description" || option.key == "adjust") continue;
    Value value = some_value(option, random);
    if (option.table.empty() && option.kind == Kind::text) {
      if (places++ != place) continue;
      // Two ports have never the same place.
      value = option.key == "address" ? fmt::format("udp:127.0.0.1:{}", 1024 + index)
                                      : std::get<std::string>(value) + port.name;
    }
    EXPECT_EQ(option.adopt(value), std::nullopt) << option.name();
    option.set(port, value);
  }
  return port;
}

PowerSettings some_supply(std::size_t index, const PortSettings& port, Random& random) {
  PowerSettings supply;
  supply.name = fmt::format("s{}", index);
  supply.gpio_chip = random() % 2 == 0 ? "gpiochip0" : "/dev/gpiochip12";
  supply.line = static_cast<int>(index);
  supply.devices = {port.name};
  supply.active_low = random() % 2 == 0;
  supply.at_start = static_cast<PowerAtStart>(random() % 3);
  supply.settle_s = static_cast<double>(random() % 6000) / 10;
  return supply;
}

Settings some_settings(Random& random) {
  Settings settings;
  for (const auto& option : daemon_options()) {
    if (option.table == "roles") continue;  // of ports that are there, below
    Value value = some_value(option, random);
    EXPECT_EQ(option.adopt(value), std::nullopt) << option.name();
    option.set(settings, value);
  }
  auto& gps = settings.instruments.gps;
  if (gps.longest_search_s < gps.least_search_s) std::swap(gps.longest_search_s, gps.least_search_s);
  CommandSettings& command = settings.command;
  if (command.min_timeout_s > command.max_timeout_s) std::swap(command.min_timeout_s, command.max_timeout_s);
  if (std::abs(command.safe_rpm) > command.max_rpm) command.safe_rpm = command.max_rpm;
  for (double& fin_deg : command.safe_fins_deg) {
    if (std::abs(fin_deg) > command.max_fin_deg) fin_deg = command.max_fin_deg;
  }
  if (!settings.remote.listen.empty()) settings.remote.path.clear();
  const auto ports = 1 + random() % 6;
  for (std::size_t i = 0; i < ports; ++i) settings.ports.push_back(some_port(i, random));
  for (const Role role : kRoles) {
    const PortSettings& port = settings.ports[random() % settings.ports.size()];
    if (can_deliver(port, role)) settings.roles.port_names.at(static_cast<std::size_t>(role)) = port.name;
  }
  for (std::size_t i = 0; i < ports; ++i) {
    if (random() % 2 == 0) settings.power.push_back(some_supply(i, settings.ports[i], random));
    if (random() % 4 == 0) settings.log.leave_out.push_back("raw." + settings.ports[i].name);
  }
  return settings;
}

TEST(ConfigRoundTrip, RandomSettingsComeBackToTheLastBit) {
  Random random(3);  // NOLINT: the same settings in every run
  for (int i = 0; i < 200; ++i) {
    const Settings settings = some_settings(random);
    const std::string toml = to_toml(settings);
    ASSERT_EQ(parse(toml, "round trip"), settings) << toml;
    ASSERT_EQ(to_toml(parse(toml, "round trip")), toml);
  }
}

TEST(ConfigRoundTrip, PortsKeepTheOrderOfTheFile) {
  Settings settings;
  for (const std::string name : {"z", "a", "m", "b"}) {
    settings.ports.push_back(default_port(name, protocols::Protocol::nmea, 4800));
    settings.ports.back().path = "/dev/" + name;
  }
  EXPECT_EQ(parse(to_toml(settings), "round trip"), settings);
}

}  // namespace
}  // namespace navcal::config
