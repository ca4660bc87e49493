// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace navcal::share {

/// Markdown of the manual page of a program, which names the pages of its commands, or of one of its commands with
/// all options, in the words of --help. Commands that no help lists are left out.
[[nodiscard]] std::string manual(const CLI::App& app);

/// --manual, also of each command, which prints that and ends the program. To be called once all commands are
/// added.
void add_manual(CLI::App& app);

/// Gives options without a description theirs, and each command the words below its options, by `texts`: a section
/// "== navcal log fetch" has a row "@--to folder for the logs" for each option, then the words. A section may name
/// several commands: "== navcal log list, navcal log fetch".
void set_help(CLI::App& app, const char* texts);

/// Reads the command line, with --manual, and runs the program, after which the exit status is 0. 1: it cannot
/// start, and standard error says why; 2: the command line is wrong. `check` throws CLI::ParseError for options
/// that do not fit together.
[[nodiscard]] int run_program(
    CLI::App& app, int argc, char** argv, const std::function<void()>& run,
    const std::function<void()>& check = [] {});

}  // namespace navcal::share
