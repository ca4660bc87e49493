// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "config/mission.h"
#include "config/option.h"

namespace navcal::config {

/// Of the tables [mission] and [start].
[[nodiscard]] const std::vector<Option<Mission>>& mission_options();

/// Of a [[step]], all kinds together; the first is `do`.
[[nodiscard]] const std::vector<Option<MissionStep>>& step_options();

/// Which keys a kind of step takes.
struct StepRule {
  /// Of each group exactly one.
  std::vector<std::vector<std::string_view>> required;
  /// Of each group one at most.
  std::vector<std::vector<std::string_view>> optional;
};
[[nodiscard]] const StepRule& rule_of(StepKind kind);

}  // namespace navcal::config
