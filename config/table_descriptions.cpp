// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "config/options.h"

namespace navcal::config {
namespace {

struct TableText {
  std::string_view table;
  std::string_view words;
};

constexpr std::array<TableText, 18> kTableDescriptions{{
    {"vehicle", "Which vehicle this is. Logs, status reports and pages name it."},
    {"log", "The log: raw bytes, samples, health and events, as MCAP files."},
    {"status", "The status socket: gpsd's protocol over TCP, read-only."},
    {"control",
     "The control socket: commands that change the daemon (calibrations, marks in the log, orders to the"
     " motor)."},
    {"environment", "Where the vehicle is used."},
    {"roles",
     "The port for each quantity, if several deliver it. Another one takes over while that port is silent."},
    {"instruments",
     "What is known of the instruments beside their ports: noise (white, one standard deviation of a reading), "
     "lag and turn-on bias. Simulator, diagnosis, navigation and calibrators share it."},
    {"calibration", "The calibrators of compass and gyros (docs/calibration.md)."},
    {"navigation", "Attitude, depth, and position between fixes (docs/navigation.md)."},
    {"command",
     "Orders to the motor card: limits, leases, and the state without anybody in charge (docs/control.md)."},
    {"battery", "The battery: charge, time and range left (docs/battery.md)."},
    {"remote",
     "The narrow link to an operator over a modem or TCP (docs/remote.md); off unless path or listen is given."},
    {"",
     "A serial port with its device. NAME (1 to 31 of a-z, 0-9, _ and -) is the device's name in reports, log and "
     "messages."},
    {"power",
     "A supply that navcald switches by a GPIO line (docs/status-protocol.md, power.on). NAME as of a port."},
    {"units", "Units of the compass's output, which its words do not state."},
    {"channels", "Zeros and sensitivities of the inertial card, per unit, channel by channel."},
    {"fix", "Processing of the receiver's positions."},
    {"mounting", "How the device sits in the vehicle (docs/navigation.md)."},
}};

}  // namespace

std::string_view table_description(std::string_view table) {
  for (const TableText& description : kTableDescriptions) {
    if (description.table == table) return description.words;
  }
  return {};
}

}  // namespace navcal::config
