// SPDX-License-Identifier: Apache-2.0
#include "config/roles.h"

namespace navcal::config {

using protocols::Protocol;

std::string_view name_of(Role role) {
  constexpr std::array<std::string_view, kRoles.size()> kNames{"heading", "field",    "rates",    "acceleration",
                                                               "depth",   "position", "velocity", "shaft"};
  return kNames.at(static_cast<std::size_t>(role));
}

bool can_deliver(Protocol protocol, Role role) {
  switch (role) {
    case Role::heading:
      return protocol == Protocol::tcm2 || protocol == Protocol::nmea;
    case Role::field:
      return protocol == Protocol::tcm2;
    case Role::rates:
    case Role::acceleration:
    case Role::depth:
      return protocol == Protocol::imu_card;
    case Role::position:
    case Role::velocity:
      return protocol == Protocol::oncore || protocol == Protocol::nmea;
    case Role::shaft:
      break;
  }
  return protocol == Protocol::motor_card;
}

Role leader_of(Role role) {
  switch (role) {
    case Role::field:
      return Role::heading;
    case Role::acceleration:
    case Role::depth:
      return Role::rates;
    case Role::velocity:
      return Role::position;
    case Role::heading:
    case Role::rates:
    case Role::position:
    case Role::shaft:
      break;
  }
  return role;
}

}  // namespace navcal::config
