// SPDX-License-Identifier: Apache-2.0
#include "cli/window_options.h"

#include "analysis/failure.h"
#include "cli/option_kinds.h"

namespace navcal::cli {

record::TimeWindow WindowOptions::window() const {
  const auto bound = [](const char* option, const std::string& text) -> std::optional<record::TimeBound> {
    if (text.empty()) return std::nullopt;
    const auto found = record::parse_time_bound(text);
    if (!found)
      throw analysis::Failure(analysis::Exit::usage, std::string(option) + ' ' + text +
                                                         ": expected seconds from the start, or UTC such as "
                                                         "2026-01-01T00:00:12Z");
    return found;
  };
  return {bound("--from", from), bound("--to", to)};
}

void add_window(CLI::App& command, WindowOptions& options, const std::string& from_otherwise) {
  add_valued(&command, "--from", "T", options.from,
             "begin of the part of each recording that is used: seconds from its start, or UTC" + from_otherwise);
  add_valued(&command, "--to", "T", options.to, "end of that part");
}

}  // namespace navcal::cli
