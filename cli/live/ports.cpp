// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/printable.h"
#include "cli/live/commands.h"
#include "cli/live/line_socket.h"
#include "ports/port_list.h"
#include "record/json/put_members.h"

namespace navcal::cli {
namespace {

using PortsJson = nlohmann::json;

struct PortsCommandOptions {
  std::filesystem::path control = "/run/navcal/control";
  std::string port, name;
  bool force = false;
};

constexpr std::chrono::milliseconds kAskAgain{100};
/// Longer than any dialogue.
constexpr std::chrono::seconds kOutcomeLimit{60};

[[noreturn]] void fail_command(const std::string& why) { throw base::Failure(base::Exit::failed, why); }

void list_commands(const PortsCommandOptions& options) {
  ControlLink link(options.control);
  const PortsJson answer = link.ask({{"command", "device.commands"}, {"port", options.port}});
  for (const PortsJson& port : answer.at("ports")) {
    for (const PortsJson& command : port.at("commands"))
      fmt::print("{:<12} {:<18} {}{}\n", port.at("port").get<std::string>(), command.at("name").get<std::string>(),
                 command.at("meaning").get<std::string>(), command.at("force") == true ? " (--force)" : "");
  }
}

/// Waits until the dialogue with the device is over, and prints the answer.
void show_outcome(ControlLink& link, const PortsCommandOptions& options, const PortsJson& number) {
  const auto until = std::chrono::steady_clock::now() + kOutcomeLimit;
  while (std::chrono::steady_clock::now() < until && !base::Interruptible::interrupted()) {
    const PortsJson answer = link.ask({{"command", "device.commands"}, {"port", options.port}});
    const PortsJson& last = answer.at("ports").at(0).at("last");
    if (last.at("number") != number) fail_command("another command was given meanwhile");
    if (last.at("state") == "done")
      return fmt::print("{}\n", base::printable(last.at("answer").get<std::string>()));
    if (last.at("state") == "failed")
      fail_command(fmt::format("{}: {}", options.name, last.at("answer").get<std::string>()));
    std::this_thread::sleep_for(kAskAgain);
  }
  fail_command(options.name + ": its end was not waited for; the log has it as an event device.command");
}

void give_command(const PortsCommandOptions& options) {
  const base::Interruptible interruptible;
  ControlLink link(options.control);
  const PortsJson answer = link.ask(
      {{"command", "device.command"}, {"port", options.port}, {"name", options.name}, {"force", options.force}});
  show_outcome(link, options, answer.at("number"));
}

void run_command(const PortsCommandOptions& options) {
  try {
    options.name.empty() ? list_commands(options) : give_command(options);
  } catch (const PortsJson::exception& error) {
    fail_command(std::string("navcald's answer cannot be read: ") + error.what());
  }
}

/// Adds `navcal ports command`, which gives the instrument at a port of a running navcald a command.
void add_ports_command(CLI::App* ports) {
  const auto [command, options] = add_command<PortsCommandOptions>(
      *ports, "command", "gives the instrument at a port of a running navcald a command", run_command);
  add_valued(command, "PORT", "PORT", options->port);
  add_valued(command, "NAME", "NAME", options->name);
  command->add_flag("--force", options->force);
  add_valued(command, "--control", "SOCKET [/run/navcal/control]", options->control);
}

using OrderedJson = nlohmann::ordered_json;

OrderedJson json_of(const ports::PortInfo& port) {
  const auto text = [](const std::string& value) {
    return value.empty() ? OrderedJson(nullptr) : OrderedJson(value);
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
          {"latency_timer_ms", port.latency_timer_ms}};
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
    fmt::print(stderr,
               "This machine has no serial ports. A USB adapter is listed once it is plugged in; without "
               "hardware, `navcal emulate --dir DIR` emulates instruments.\n");
  }
}

}  // namespace

void add_ports(CLI::App& app) {
  auto* command = app.add_subcommand("ports", "serial ports of this machine and their properties");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json);
  add_ports_command(command);
  add_ports_send_calibration(*command);
  command->callback([command, json] {
    if (command->get_subcommands().empty()) run(*json);
  });
}

}  // namespace navcal::cli
