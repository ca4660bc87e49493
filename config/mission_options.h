// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "config/mission.h"
#include "config/option.h"

namespace navcal::config {

template <>
inline constexpr std::string_view kUntitled<MissionStep> = "step";

/// Options of the tables [mission] and [start].
[[nodiscard]] const std::vector<Option<Mission>>& mission_options();

/// Options of a [[step]], all kinds together, in the order in which a file has them; the first is `do`. What a
/// step does not say is Unsupported.
[[nodiscard]] const std::vector<Option<MissionStep>>& step_options();

/// Keys that a kind of step takes.
struct StepRule {
  /// Exactly one key of each group must be given.
  std::vector<std::vector<std::string_view>> required;
  /// At most one key of each group may be given.
  std::vector<std::vector<std::string_view>> optional;
};
[[nodiscard]] const StepRule& rule_of(StepKind kind);

}  // namespace navcal::config
