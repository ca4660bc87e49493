// SPDX-License-Identifier: Apache-2.0
#include "ports/finder.h"

#include <fmt/format.h>

#include <filesystem>

#include "ports/port_list.h"

namespace navcal::ports {
namespace {

namespace fs = std::filesystem;

std::optional<Found> find_by_serial(const std::string& serial, std::string& why) {
  for (const PortInfo& port : list_ports()) {
    if (port.usb_serial == serial) return Found{port.path, describe(port)};
  }
  why = fmt::format("no USB adapter with serial number {} is connected", serial);
  return std::nullopt;
}

std::string description_of(const fs::path& device) {
  if (device.parent_path() == "/dev/pts") return {};
  for (const PortInfo& port : list_ports()) {
    if (port.path == device) return describe(port);
  }
  return {};
}

}  // namespace

std::optional<Found> find_port(const config::PortSettings& settings, std::string& why) {
  if (!settings.usb_serial.empty()) return find_by_serial(settings.usb_serial, why);
  const fs::path name =
      settings.udev_name.empty() ? fs::path(settings.path) : fs::path("/dev") / settings.udev_name;
  std::error_code error;
  const fs::path device = fs::canonical(name, error);
  if (error) {
    why = fmt::format("{}: {}", name.string(),
                      error == std::errc::no_such_file_or_directory ? "no such device" : error.message());
    return std::nullopt;
  }
  return Found{device.string(), description_of(device)};
}

}  // namespace navcal::ports
