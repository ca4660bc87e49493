// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "config/options.h"
#include "config/text_rules.h"

namespace navcal::config {
namespace {

constexpr std::array<std::string_view, kRoles.size()> kDescriptions{
    "Port whose compass gives the heading. Empty: the best that delivers, a TCM2 before NMEA.",
    "Port whose magnetometer gives the magnetic field, which the calibrators learn from. Empty: as for heading.",
    "Port whose gyros give the rates. Empty: the first that delivers.",
    "Port whose accelerometers give the specific force. Empty: as for rates.",
    "Port that gives the depth. Empty: as for rates.",
    "Port of the receiver that gives the position. Empty: the one with the smaller stated error.",
    "Port of the receiver that gives the velocity over ground. Empty: as for position.",
    "Port that gives the speed of the propeller's shaft. Empty: the first that delivers.",
    "Port of the echo sounder that gives the height above the sea floor. Empty: the first that delivers.",
    "Port of the Doppler log that gives the velocity over the bottom. Empty: the first that delivers.",
    "Port of the Doppler log that gives the velocity through the water. Empty: as for bottom_velocity.",
    "Port that gives a true heading which the compass is calibrated against: a receiver with two antennas, a gyro "
    "compass, a survey. Empty: none.",
};

}  // namespace

std::vector<Option<Settings>> role_options() {
  const auto table = table_of<Settings>("roles", &Settings::roles);
  std::vector<Option<Settings>> options;
  for (const Role role : kRoles) {
    const auto at = static_cast<std::size_t>(role);
    options.push_back(table.text(
        name_of(role), [at](auto& roles) -> auto& { return roles.port_names.at(at); }, is_port_name_or_nothing,
        "a port's name, or nothing", kDescriptions.at(at)));
  }
  return options;
}

}  // namespace navcal::config
