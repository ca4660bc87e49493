// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// Adds `navcal ports command`, which gives the instrument at a port of a running navcald a command.
void add_ports_command(CLI::App* ports);

}  // namespace navcal::cli
