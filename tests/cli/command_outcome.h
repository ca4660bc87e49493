// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"

namespace navcal::cli::test {

struct Outcome {
  int status = 0;
  std::string message, output;
};

/// navcal log with those of its subcommands that read files.
inline void add_log_of_files(CLI::App& app) {
  add_log(app);
  CLI::App& log = *app.get_subcommand("log");
  add_log_import(log);
  add_log_surfacings(log);
}

/// One subcommand run within this program; `arguments` begin with its name.
inline Outcome run_command(void (*add)(CLI::App&), std::vector<std::string> arguments) {
  CLI::App app;
  add(app);
  std::reverse(arguments.begin(), arguments.end());
  Outcome outcome;
  ::testing::internal::CaptureStdout();
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    outcome = {static_cast<int>(base::Exit::usage), error.what(), ""};
  } catch (const std::exception& error) {
    outcome = {static_cast<int>(exit_status_of(error)), error.what(), ""};
  }
  outcome.output = ::testing::internal::GetCapturedStdout();
  return outcome;
}

}  // namespace navcal::cli::test
