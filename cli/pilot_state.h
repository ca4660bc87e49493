// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "autopilot/reading.h"

namespace navcal::cli {

/// A line of class STATE (docs/status-protocol.md).
struct StateLine {
  double time_s = 0;      ///< UTC, of validity
  bool magnetic = false;  ///< the heading is from magnetic north
  autopilot::Reading reading;
};

/// nullopt for a line of another class and for what is no JSON. A value of the wrong kind counts as unknown.
[[nodiscard]] std::optional<StateLine> parse_state(std::string_view line);

}  // namespace navcal::cli
