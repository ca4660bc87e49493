// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "config/load.h"
#include "protocols/device_types.h"

namespace navcal::config {

int default_baud(protocols::Protocol protocol) { return protocols::device_type(protocol).baud; }

PortSettings default_port(std::string name, protocols::Protocol protocol, int baud) {
  const protocols::DeviceType& device = protocols::device_type(protocol);
  PortSettings port;
  port.name = std::move(name);
  port.protocol = protocol;
  port.baud = baud;
  port.latency_s = device.latency_s;
  port.latency_std_s = device.latency_std_s;
  port.rate_Hz = device.rate_Hz;
  return port;
}

}  // namespace navcal::config
