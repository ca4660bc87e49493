// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "emulation/place_arguments.h"
#include "record/recording.h"
#include "sim/instruments/clock_factor.h"

namespace navcal::cli {

/// --from and --to as they were given.
struct WindowOptions {
  std::string from, to;
  /// Throws base::Failure (usage) for what is no time, and where none lies between both.
  [[nodiscard]] record::TimeWindow window() const;
};
void add_window(CLI::App& command, WindowOptions& options, const std::string& from_otherwise = {});

/// Adds --effect and --effects, the departures of a simulated vehicle from the nominal model.
void add_effect_options(CLI::App* command, std::vector<std::string>& effects, std::filesystem::path& file);

/// Adds --clock PORT=FACTOR, repeatable, for simulated instruments.
void add_clock_option(CLI::App* command, std::vector<sim::ClockFactor>& clocks);

/// Adds --place and --field; --date is the caller's, since it means something else to each command.
void add_place_and_field(CLI::App* command, emulation::PlaceArguments& arguments);

}  // namespace navcal::cli
