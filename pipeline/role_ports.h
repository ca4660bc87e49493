// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "config/roles.h"

namespace navcal::pipeline {

using config::kRoles;
using config::Role;

/// One port for each role, where there is one.
struct RolePorts {
  std::array<std::optional<std::uint16_t>, kRoles.size()> ports{};
  [[nodiscard]] std::optional<std::uint16_t> operator[](Role role) const {
    return ports.at(static_cast<std::size_t>(role));
  }
  bool operator==(const RolePorts&) const = default;
};

}  // namespace navcal::pipeline
