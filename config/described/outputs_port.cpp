// SPDX-License-Identifier: Apache-2.0
#include "config/described/outputs_port.h"

#include <string>

#include "config/described/description_file.h"
#include "config/load.h"

namespace navcal::config {
PortSettings outputs_port() {
  PortSettings port = default_port(std::string(kOutputsPort), protocols::Protocol::described, kOutputsBaud);
  port.device = "actuator-outputs.toml";
  port.description = outputs_description();
  port.described = parse_description(port.description, port.device);
  port.latency_s = kOutputsLatency_s;
  port.latency_std_s = 0.0005;
  port.rate_Hz = 10;
  return port;
}

}  // namespace navcal::config
