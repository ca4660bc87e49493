// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/live/shared_options.h"
#include "emulation/place_arguments.h"
#include "gap/verdict/request.h"
#include "report/gap_words.h"

namespace navcal::cli {

/// Options that every command has which diagnoses recordings.
struct GapRequestOptions : WindowOptions {
  report::GapSource source;
  emulation::PlaceArguments where;
  std::vector<std::string> without;
  std::filesystem::path cache;
  int bank_missions = gap::Request{}.bank_missions;
  std::uint64_t bank_seed = gap::Request{}.bank_seed;
};

void add_gap_request(CLI::App& command, GapRequestOptions& options);

/// Where the user's null banks are, after the XDG base directories; empty when there is no such place.
[[nodiscard]] std::filesystem::path usual_cache();

/// The request without its vehicle where that is a layout. Throws config::Error, base::Failure.
[[nodiscard]] gap::Request gap_request_of(const GapRequestOptions& options, bool is_of_layout = false);

}  // namespace navcal::cli
