// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/printable.h"
#include "cli/commands.h"
#include "cli/ports_command.h"
#include "ports/port_list.h"

namespace navcal::cli {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson json_of(const ports::PortInfo& port) {
  const auto text = [](const std::string& value) {
    return value.empty() ? OrderedJson(nullptr) : OrderedJson(value);
  };
  const auto number = [](const std::optional<int>& value) {
    return value ? OrderedJson(*value) : OrderedJson(nullptr);
  };
  const auto id = [](const std::optional<int>& value) {
    return value ? OrderedJson(fmt::format("{:04x}", *value)) : OrderedJson(nullptr);
  };
  return {{"class", "PORT"},
          {"path", port.path},
          {"description", text(port.description)},
          {"transport", port.transport},
          {"usb_vid", id(port.usb_vid)},
          {"usb_pid", id(port.usb_pid)},
          {"usb_manufacturer", text(port.usb_manufacturer)},
          {"usb_product", text(port.usb_product)},
          {"usb_serial", text(port.usb_serial)},
          {"driver", text(port.driver)},
          {"latency_timer_ms", number(port.latency_timer_ms)}};
}

void run(bool json) {
  const auto list = ports::list_ports();
  for (const ports::PortInfo& port : list) {
    if (json) {
      fmt::print("{}\n", json_of(port).dump(-1, ' ', false, OrderedJson::error_handler_t::replace));
    } else {
      fmt::print("{}  {}\n", port.path, base::printable(ports::describe(port)));
    }
  }
  if (list.empty()) {
    fmt::print(
        stderr,
        "This machine has no serial ports. A USB adapter is listed once it is plugged in; without hardware, "
        "`navcal emulate --dir DIR` emulates instruments.\n");
  }
}

}  // namespace

void add_ports(CLI::App& app) {
  auto* command = app.add_subcommand("ports", "serial ports of this machine and their properties");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "one JSON object a line; unknown values are null");
  command->footer(
      "A port can be configured by its path or, better, by the serial number of its USB adapter (usb_serial), "
      "which\n"
      "is the same at any USB socket.\n\nExample: navcal ports");
  add_ports_command(command);
  command->callback([command, json] {
    if (command->get_subcommands().empty()) run(*json);
  });
}

}  // namespace navcal::cli
