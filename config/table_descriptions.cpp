// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "config/options.h"

namespace navcal::config {
namespace {

struct Description {
  std::string_view table;
  std::string_view words;
};

constexpr std::array<Description, 12> kDescriptions{{
    {"log", "The log: raw bytes, samples, health and events, as MCAP files."},
    {"status", "The status socket: gpsd's protocol over TCP, for reading only."},
    {"control",
     "The control socket: what changes the daemon (calibrations, marks in the log, orders to the motor)."},
    {"environment", "Where the vehicle is used."},
    {"roles",
     "Which port serves what, where several deliver the same. Another one takes over while it is silent."},
    {"calibration", "The calibrators of compass and gyros (docs/calibration.md)."},
    {"navigation", "Attitude, depth, and position between fixes (docs/navigation.md)."},
    {"command",
     "Orders to the motor card: limits, leases, and the state without anybody in charge (docs/control.md)."},
    {"",
     "A serial port with its device. NAME (1 to 31 of a-z, 0-9, _ and -) is the device's name in reports, log and "
     "messages."},
    {"units", "How a compass speaks: the unit is not in its words."},
    {"channels", "Zeros and sensitivities of the inertial card, per unit, channel by channel."},
    {"fix", "How positions are taken from a receiver."},
}};

}  // namespace

std::string_view table_description(std::string_view table) {
  for (const Description& description : kDescriptions) {
    if (description.table == table) return description.words;
  }
  return {};
}

}  // namespace navcal::config
