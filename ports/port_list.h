// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace navcal::ports {

/// A serial port of this machine and what is known of it; empty strings and nullopt where nothing is.
struct PortInfo {
  std::string path;
  std::string description;
  std::string transport;  ///< "native", "usb", "bluetooth"
  std::optional<int> usb_vid, usb_pid;
  std::string usb_manufacturer, usb_product, usb_serial;
  std::string driver;
  std::optional<int> latency_timer_ms;
};

/// All of them, sorted by path; pseudo-terminals are not among them. Empty also where /sys cannot be read.
[[nodiscard]] std::vector<PortInfo> list_ports();

/// One line for people: "FT232R USB UART (USB 0403:6001, serial number A50285BI, driver ftdi_sio)".
[[nodiscard]] std::string describe(const PortInfo& port);

}  // namespace navcal::ports
