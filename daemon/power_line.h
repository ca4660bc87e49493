// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "config/settings.h"

namespace navcal::daemon {

/// The line that switches a supply. Narrow, so that a test can put its own in place of the kernel's.
class PowerLine {
 public:
  virtual ~PowerLine() = default;
  /// nullopt: the line is an input, or cannot be read.
  [[nodiscard]] virtual std::optional<bool> is_on() const = 0;
  /// Why it cannot be switched; empty: done.
  [[nodiscard]] virtual std::string set(bool on) = 0;
};

/// Takes the line of a supply and does to it what its at_start says; null and `problem` when it cannot be taken.
[[nodiscard]] std::unique_ptr<PowerLine> open_gpio_line(const config::PowerSettings& settings,
                                                        std::string& problem);

}  // namespace navcal::daemon
