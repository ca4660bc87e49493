// SPDX-License-Identifier: Apache-2.0
#include "config/roles.h"

#include "config/settings.h"
#include "protocols/described/description.h"

namespace navcal::config {
namespace {

using protocols::described::Meaning;

/// A role, and what serves it.
struct RoleRow {
  std::string_view name;
  Role leader;
  Meaning first, second, third;  ///< a description with one of them delivers it
};

const RoleRow& row_of(Role role) {
  using enum Meaning;
  using R = Role;
  // In the order of the roles.
  static constexpr std::array<RoleRow, kRoles.size()> kRows{{
      {"heading", R::heading, field_x, heading, heading_true},
      {"field", R::heading, field_x, none, none},
      {"rates", R::rates, rate_x, none, none},
      {"acceleration", R::rates, specific_force_x, none, none},
      {"depth", R::rates, depth, pressure, none},
      {"position", R::position, latitude, none, none},
      {"velocity", R::position, speed, none, none},
      {"shaft", R::shaft, rpm, none, none},
      {"altitude", R::altitude, altitude, none, none},
      {"bottom_velocity", R::bottom_velocity, bottom_velocity_x, bottom_velocity_north, none},
      {"water_velocity", R::bottom_velocity, water_velocity_x, water_velocity_north, none},
      {"heading_reference", R::heading_reference, field_x, heading, heading_true},
  }};
  return kRows.at(static_cast<std::size_t>(role));
}

}  // namespace

std::string_view name_of(Role role) { return row_of(role).name; }

Role leader_of(Role role) { return row_of(role).leader; }

bool can_deliver(protocols::Protocol protocol, Role role) {
  const auto& device = protocols::device_type(protocol);
  // The heading of an autopilot is an estimate by the compass that would be calibrated against it.
  if (role == Role::heading_reference && protocol == protocols::Protocol::mavlink) return false;
  const bool is_heading = role == Role::heading || role == Role::heading_reference;
  return device.delivers.has(is_heading ? Role::heading : role) || (is_heading && device.heading_if_chosen);
}

bool can_deliver(const PortSettings& port, Role role) {
  if (!port.described) return can_deliver(port.protocol, role);
  const auto sends = [&](Meaning meaning) { return meaning != Meaning::none && has(*port.described, meaning); };
  const RoleRow& row = row_of(role);
  return sends(row.first) || sends(row.second) || sends(row.third);
}

bool delivers_always(const PortSettings& port) {
  return port.described || protocols::device_type(port.protocol).delivers_always;
}

}  // namespace navcal::config
