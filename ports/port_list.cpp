// SPDX-License-Identifier: Apache-2.0
#include "ports/port_list.h"

#include <fmt/format.h>
#include <libserialport.h>

#include <algorithm>
#include <memory>

#include "ports/sysfs.h"

namespace navcal::ports {
namespace {

std::string text(const char* maybe) { return maybe == nullptr ? std::string{} : std::string(maybe); }

std::string transport_of(const sp_port* port) {
  switch (sp_get_port_transport(port)) {
    case SP_TRANSPORT_USB: return "usb";
    case SP_TRANSPORT_BLUETOOTH: return "bluetooth";
    case SP_TRANSPORT_NATIVE: break;
  }
  return "native";
}

PortInfo info_of(const sp_port* port) {
  PortInfo info;
  info.path = text(sp_get_port_name(port));
  info.description = text(sp_get_port_description(port));
  info.transport = transport_of(port);
  if (int vid = 0, pid = 0; sp_get_port_usb_vid_pid(port, &vid, &pid) == SP_OK) {
    info.usb_vid = vid;
    info.usb_pid = pid;
  }
  info.usb_manufacturer = text(sp_get_port_usb_manufacturer(port));
  info.usb_product = text(sp_get_port_usb_product(port));
  info.usb_serial = text(sp_get_port_usb_serial(port));
  const SysfsTty sysfs(info.path);
  info.driver = sysfs.driver();
  info.latency_timer_ms = sysfs.latency_timer_ms();
  return info;
}

}  // namespace

std::vector<PortInfo> list_ports() {
  std::vector<PortInfo> ports;
  sp_port** list = nullptr;
  if (sp_list_ports(&list) != SP_OK) return ports;
  const std::unique_ptr<sp_port*, decltype(&sp_free_port_list)> owner(list, &sp_free_port_list);
  for (sp_port** port = list; *port != nullptr; ++port) ports.push_back(info_of(*port));
  std::ranges::sort(ports, [](const PortInfo& a, const PortInfo& b) { return a.path < b.path; });
  return ports;
}

std::string describe(const PortInfo& port) {
  std::string known;
  const auto add = [&](const std::string& fact) { known += (known.empty() ? "" : ", ") + fact; };
  if (port.usb_vid && port.usb_pid) add(fmt::format("USB {:04x}:{:04x}", *port.usb_vid, *port.usb_pid));
  if (!port.usb_serial.empty()) add("serial number " + port.usb_serial);
  if (!port.driver.empty()) add("driver " + port.driver);
  if (port.latency_timer_ms) add(fmt::format("latency timer {} ms", *port.latency_timer_ms));
  const std::string& name = port.usb_product.empty() ? port.description : port.usb_product;
  if (known.empty()) return name;
  return name.empty() ? known : fmt::format("{} ({})", name, known);
}

}  // namespace navcal::ports
