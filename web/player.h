// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace navcal::web {

/// The controls of a recording that is played (docs/web.md). One thread.
class Player {
 public:
  virtual ~Player() = default;
  /// A JSON object with one of `play` (true, false), `seek` (seconds from the beginning) and `speed` (factor of
  /// the recorded speed). Anything else is ignored.
  virtual void command(std::string_view json) = 0;
  /// Appends the state as a JSON object: `file`, `playing`, `speed`, `position_s`, `duration_s`, `begin` (UTC, s).
  virtual void append_state(std::string& out) const = 0;
};

}  // namespace navcal::web
