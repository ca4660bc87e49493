// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "sim/instruments/clock_factor.h"

namespace navcal::cli {

/// Adds --clock PORT=FACTOR, repeatable, for simulated instruments.
void add_clock_option(CLI::App* command, std::vector<sim::ClockFactor>& clocks);

}  // namespace navcal::cli
