// SPDX-License-Identifier: Apache-2.0
#include "config/roles.h"

#include "config/settings.h"
#include "protocols/described/description.h"
#include "protocols/device_types.h"

namespace navcal::config {

std::string_view name_of(Role role) {
  constexpr std::array<std::string_view, kRoles.size()> kNames{
      "heading",  "field", "rates",    "acceleration",    "depth",          "position",
      "velocity", "shaft", "altitude", "bottom_velocity", "water_velocity", "heading_reference"};
  return kNames.at(static_cast<std::size_t>(role));
}

namespace {

bool delivers_role(const protocols::Delivery& delivers, Role role) {
  switch (role) {
    case Role::heading:
    case Role::heading_reference: return delivers.heading;
    case Role::field: return delivers.field;
    case Role::rates: return delivers.rates;
    case Role::acceleration: return delivers.acceleration;
    case Role::depth: return delivers.depth;
    case Role::position: return delivers.position;
    case Role::velocity: return delivers.velocity;
    case Role::shaft: return delivers.shaft;
    case Role::altitude: return delivers.altitude;
    case Role::bottom_velocity: return delivers.bottom_velocity;
    case Role::water_velocity: break;
  }
  return delivers.water_velocity;
}

/// What a device with this description measures.
protocols::Delivery delivery_of(const protocols::described::Description& description) {
  const auto sends = [&](protocols::described::Meaning meaning) { return has(description, meaning); };
  using enum protocols::described::Meaning;
  protocols::Delivery delivers;
  delivers.field = sends(field_x);
  delivers.heading = delivers.field || sends(heading) || sends(heading_true);
  delivers.rates = sends(rate_x);
  delivers.acceleration = sends(specific_force_x);
  delivers.depth = sends(depth) || sends(pressure);
  delivers.position = sends(latitude);
  delivers.velocity = sends(speed);
  delivers.shaft = sends(rpm);
  delivers.altitude = sends(altitude);
  delivers.bottom_velocity = sends(bottom_velocity_x) || sends(bottom_velocity_north);
  delivers.water_velocity = sends(water_velocity_x) || sends(water_velocity_north);
  return delivers;
}

}  // namespace

bool can_deliver(protocols::Protocol protocol, Role role) {
  const auto& device = protocols::device_type(protocol);
  const bool is_heading = role == Role::heading || role == Role::heading_reference;
  return delivers_role(device.delivers, role) || (is_heading && device.heading_if_chosen);
}

bool can_deliver(const PortSettings& port, Role role) {
  if (port.described) return delivers_role(delivery_of(*port.described), role);
  return can_deliver(port.protocol, role);
}

bool delivers_always(const PortSettings& port) {
  return port.described || protocols::device_type(port.protocol).delivers_always;
}

Role leader_of(Role role) {
  switch (role) {
    case Role::field: return Role::heading;
    case Role::acceleration:
    case Role::depth: return Role::rates;
    case Role::velocity: return Role::position;
    case Role::water_velocity: return Role::bottom_velocity;
    case Role::heading:
    case Role::rates:
    case Role::position:
    case Role::shaft:
    case Role::altitude:
    case Role::bottom_velocity:
    case Role::heading_reference: break;
  }
  return role;
}

}  // namespace navcal::config
