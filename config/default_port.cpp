// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "config/load.h"

namespace navcal::config {

using protocols::Protocol;

int default_baud(Protocol protocol) {
  switch (protocol) {
    case Protocol::tcm2:
    case Protocol::oncore:
      return 9600;
    case Protocol::imu_card:
      return 57600;
    case Protocol::motor_card:
      return 19200;
    case Protocol::nmea:
      return 4800;
  }
  return 9600;
}

PortSettings default_port(std::string name, Protocol protocol, int baud) {
  PortSettings port;
  port.name = std::move(name);
  port.protocol = protocol;
  port.baud = baud;
  switch (protocol) {
    case Protocol::tcm2:
      port.latency_s = 0.050;
      port.latency_std_s = 0.002;
      port.rate_Hz = 10;
      break;
    case Protocol::imu_card:
      port.latency_s = 0.025;
      port.latency_std_s = 0.0005;
      port.rate_Hz = 20;
      break;
    case Protocol::oncore:
      port.latency_s = 0.300;
      port.latency_std_s = 0.020;
      port.rate_Hz = 1;
      break;
    case Protocol::motor_card:
      port.latency_s = 0.005;
      port.latency_std_s = 0.001;
      port.rate_Hz = 10;
      break;
    case Protocol::nmea:
      // Receivers and compasses of all kinds: nothing is known of them but that they are not quicker than this.
      port.latency_std_s = 0.050;
      break;
  }
  return port;
}

}  // namespace navcal::config
