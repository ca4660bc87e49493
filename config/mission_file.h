// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "config/error.h"
#include "config/mission.h"

namespace navcal::config {

/// A mission by the name of a shipped one ("survey"), or from a file: whatever ends in .toml or has a / in it.
/// Throws Error; for a name that is not known it lists those that are.
[[nodiscard]] Mission load_mission(const std::string& name_or_file);

/// A mission from memory; `name` stands for the file in messages. Throws Error.
[[nodiscard]] Mission parse_mission(std::string_view toml, std::string_view name);

/// A mission that comes with the program.
struct ShippedMission {
  std::string_view name;
  std::string_view toml;
};
[[nodiscard]] const std::vector<ShippedMission>& shipped_missions();

}  // namespace navcal::config
