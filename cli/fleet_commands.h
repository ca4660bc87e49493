// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// `navcal fleet submit`: all open tasks of a plan, on this machine or by Slurm.
void add_fleet_submit(CLI::App& fleet);

/// Adds `navcal fleet trial record` and `navcal fleet trial score`.
void add_fleet_trial(CLI::App& parent);

}  // namespace navcal::cli
