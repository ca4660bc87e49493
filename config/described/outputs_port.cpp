// SPDX-License-Identifier: Apache-2.0
#include "config/described/outputs_port.h"

#include <string>

#include "config/described/description_file.h"
#include "config/load.h"

namespace navcal::config {
namespace {

constexpr std::string_view kOutputsDescription =
    R"(# Commands to the actuators of a simulated layout (navcal simulate --vehicle LAYOUT.toml), ten times a second:
#   $PNCAO,1500,1620,1500,1500,,,,*52
# outputs 1 to 8 as pulses in us, thrusters first, then surfaces, ballasts and moving masses (docs/simulator.md). Outputs
# that the vehicle does not have are empty; $PNCAP has 9 to 16 where there are more than 8.
name = "actuator outputs"
form = "text"
baud = 115200
rate_Hz = 10
latency_ms = 5
latency_std_ms = 0.5

[[frame]]
id = "PNCAO"
start = "$PNCAO,"
checksum = "nmea"
fields = 8
field = [
  { sensor = "output1", number = 1, unit = "us", low = 500, high = 2500 },
  { sensor = "output2", number = 2, unit = "us", low = 500, high = 2500 },
  { sensor = "output3", number = 3, unit = "us", low = 500, high = 2500 },
  { sensor = "output4", number = 4, unit = "us", low = 500, high = 2500 },
  { sensor = "output5", number = 5, unit = "us", low = 500, high = 2500 },
  { sensor = "output6", number = 6, unit = "us", low = 500, high = 2500 },
  { sensor = "output7", number = 7, unit = "us", low = 500, high = 2500 },
  { sensor = "output8", number = 8, unit = "us", low = 500, high = 2500 },
]

[[frame]]
id = "PNCAP"
start = "$PNCAP,"
checksum = "nmea"
fields = 8
field = [
  { sensor = "output9", number = 1, unit = "us", low = 500, high = 2500 },
  { sensor = "output10", number = 2, unit = "us", low = 500, high = 2500 },
  { sensor = "output11", number = 3, unit = "us", low = 500, high = 2500 },
  { sensor = "output12", number = 4, unit = "us", low = 500, high = 2500 },
  { sensor = "output13", number = 5, unit = "us", low = 500, high = 2500 },
  { sensor = "output14", number = 6, unit = "us", low = 500, high = 2500 },
  { sensor = "output15", number = 7, unit = "us", low = 500, high = 2500 },
  { sensor = "output16", number = 8, unit = "us", low = 500, high = 2500 },
]
)";

}  // namespace

PortSettings outputs_port() {
  PortSettings port = default_port(std::string(kOutputsPort), protocols::Protocol::described, kOutputsBaud);
  port.device = "actuator-outputs.toml";
  port.description = kOutputsDescription;
  port.described = parse_description(kOutputsDescription, port.device);
  port.latency_s = kOutputsLatency_s;
  port.latency_std_s = 0.0005;
  port.rate_Hz = 10;
  return port;
}

}  // namespace navcal::config
