// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "record/recording.h"

namespace navcal::cli {

/// --from and --to as they were given.
struct WindowOptions {
  std::string from, to;
  /// Throws analysis::Failure (usage) for what is no time.
  [[nodiscard]] record::TimeWindow window() const;
};
void add_window(CLI::App& command, WindowOptions& options, const std::string& from_otherwise = {});

}  // namespace navcal::cli
