// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "config/mission.h"

namespace navcal::sim {

/// Degrees of freedom that a mission needs: for each the first step that does, "step[3] (turn)".
struct MissionNeeds {
  std::optional<std::string> surge;  ///< a speed, or a way to be made
  std::optional<std::string> yaw;    ///< another heading, or a rudder
  std::optional<std::string> pitch;  ///< an elevator
  /// Fins 1 to 3 that steps move by themselves.
  std::array<std::optional<std::string>, 3> fins;
};

/// Every mission holds a depth as well. The shaft speed of the start is a speed for those that can make one.
[[nodiscard]] MissionNeeds needs_of(const config::Mission& mission);

/// "step[3] (turn)": number from 1 and what it does.
[[nodiscard]] std::string step_words(const config::Mission& mission, std::size_t step);

}  // namespace navcal::sim
