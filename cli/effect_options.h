// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/instruments/clock_factor.h"

namespace navcal::cli {

/// Adds --effect and --effects, the departures of a simulated vehicle from the nominal model.
void add_effect_options(CLI::App* command, std::vector<std::string>& effects, std::filesystem::path& file);

/// Adds --clock PORT=FACTOR, repeatable, for simulated instruments.
void add_clock_option(CLI::App* command, std::vector<sim::ClockFactor>& clocks);

}  // namespace navcal::cli
