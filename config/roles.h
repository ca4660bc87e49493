// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "protocols/device_types.h"

namespace navcal::config {

using protocols::Role;

inline constexpr std::array kRoles{Role::heading,         Role::field,          Role::rates,
                                   Role::acceleration,    Role::depth,          Role::position,
                                   Role::velocity,        Role::shaft,          Role::altitude,
                                   Role::bottom_velocity, Role::water_velocity, Role::heading_reference};

/// As in the table [roles] of the configuration: "heading", "field", ..., "bottom_velocity".
[[nodiscard]] std::string_view name_of(Role role);

/// True when a device with that protocol can deliver the role, be it only where [roles] chooses it.
[[nodiscard]] bool can_deliver(protocols::Protocol protocol, Role role);

struct PortSettings;
/// True when the device at a port can deliver the role: of a described device, by its description.
[[nodiscard]] bool can_deliver(const PortSettings& port, Role role);
/// True when the device at a port always sends what it can deliver.
[[nodiscard]] bool delivers_always(const PortSettings& port);

/// The role whose device, where the operator has chosen one, serves this role as well if it can: the field follows
/// the heading, acceleration and depth follow the rates, the velocity follows the position, the water velocity the
/// bottom velocity. Any other follows itself.
[[nodiscard]] Role leader_of(Role role);

/// The operator's choice: a port's name for each role; empty: the best that delivers.
struct RoleSettings {
  std::array<std::string, kRoles.size()> port_names{};

  [[nodiscard]] const std::string& port_name(Role role) const {
    return port_names.at(static_cast<std::size_t>(role));
  }
  /// The choice for a role, or else for the one that it follows.
  [[nodiscard]] const std::string& chosen_name(Role role) const {
    const std::string& own = port_name(role);
    return own.empty() ? port_name(leader_of(role)) : own;
  }
  bool operator==(const RoleSettings&) const = default;
};

}  // namespace navcal::config
