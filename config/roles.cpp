// SPDX-License-Identifier: Apache-2.0
#include "config/roles.h"

#include "protocols/device_types.h"

namespace navcal::config {

std::string_view name_of(Role role) {
  constexpr std::array<std::string_view, kRoles.size()> kNames{
      "heading",  "field", "rates",    "acceleration",    "depth",         "position",
      "velocity", "shaft", "altitude", "bottom_velocity", "water_velocity"};
  return kNames.at(static_cast<std::size_t>(role));
}

bool can_deliver(protocols::Protocol protocol, Role role) {
  const protocols::Delivery& delivers = protocols::device_type(protocol).delivers;
  switch (role) {
    case Role::heading:
      return delivers.heading;
    case Role::field:
      return delivers.field;
    case Role::rates:
      return delivers.rates;
    case Role::acceleration:
      return delivers.acceleration;
    case Role::depth:
      return delivers.depth;
    case Role::position:
      return delivers.position;
    case Role::velocity:
      return delivers.velocity;
    case Role::shaft:
      return delivers.shaft;
    case Role::altitude:
      return delivers.altitude;
    case Role::bottom_velocity:
      return delivers.bottom_velocity;
    case Role::water_velocity:
      break;
  }
  return delivers.water_velocity;
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
    case Role::water_velocity:
      return Role::bottom_velocity;
    case Role::heading:
    case Role::rates:
    case Role::position:
    case Role::shaft:
    case Role::altitude:
    case Role::bottom_velocity:
      break;
  }
  return role;
}

}  // namespace navcal::config
