// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "base/failure.h"
#include "cli/live/option_kinds.h"

namespace navcal::cli {

// One file and one line here per subcommand: the build calls all of them in this order and lists each in its
// group. Each adds itself to the application with its options, help and example. The callback runs the command and
// throws Failure when it cannot.

// Group: Look
void add_watch(CLI::App& app);
void add_view(CLI::App& app);
void add_replay(CLI::App& app);
void add_decode(CLI::App& app);
void add_log(CLI::App& app);

// Group: Calibrate
void add_calibrate(CLI::App& app);
void add_noise(CLI::App& app);

// Group: Diagnose
void add_audit(CLI::App& app);
void add_gap(CLI::App& app);
void add_identify(CLI::App& app);
void add_fleet(CLI::App& app);

// Group: Drive
void add_pilot(CLI::App& app);
void add_remote(CLI::App& app);

// Group: Practise
void add_simulate(CLI::App& app);
void add_emulate(CLI::App& app);
void add_play(CLI::App& app);

// Group: Set up
void add_start(CLI::App& app);
void add_doctor(CLI::App& app);
void add_ports(CLI::App& app);
void add_devices(CLI::App& app);
void add_vehicle(CLI::App& app);
void add_field(CLI::App& app);
void add_completion(CLI::App& app);

// Group: Research
void add_research(CLI::App& app);

// Not listed: these names are kept for scripts; navcal research lists them.
void add_thesis(CLI::App& app);
void add_validate_runs(CLI::App& app);

// Of log, each in a file of its own: those that read files,
void add_log_import(CLI::App& app);
void add_log_surfacings(CLI::App& app);
/// and those that ask a running navcald (list, fetch, start, stop and select).
void add_log_control(CLI::App& app);

// Called by the command that they are part of:
void add_gap_next(CLI::App& gap);
void add_gap_watch(CLI::App& gap);
void add_gap_trial(CLI::App& gap);
void add_fleet_submit(CLI::App& fleet);
void add_ports_send_calibration(CLI::App& ports);
/// Stands for a command that is not in this program, and says how to get it.
void add_left_out(CLI::App& parent, const std::string& name);

/// The texts of command_help.txt, by share::set_help.
void set_help(CLI::App& app);

/// All of them, with their words (written by cli/live/command_table.cmake).
void add_commands(CLI::App& parent);

}  // namespace navcal::cli
