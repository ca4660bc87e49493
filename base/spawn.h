// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace navcal::base {

/// A program that is to run as a process of its own.
struct Program {
  std::vector<std::string> command;  ///< a program without a slash is looked for in PATH
  std::string errors = "/dev/null";  ///< the file that takes its standard error
  std::string output = "/dev/null";  ///< the same of its standard output
  std::string folder{};              ///< where it works; empty: where we do
  std::string variable{};            ///< "NAME=value" of its environment, instead of ours
};

/// Starts it in a process group of its own. Nothing comes in, and no other file is handed down. Throws
/// std::system_error when it cannot be started.
[[nodiscard]] pid_t spawn(Program program);

/// Waits for the end of a child; the status of wait().
int wait_for(pid_t child);

/// Status of a program that is not there, as in a shell.
inline constexpr int kNoSuchProgram = 127;

/// A command of another program that has ended.
struct CommandOutput {
  int status = 0;  ///< of exit; 128 + number of the signal that ended it
  std::string out, err;
};

/// Runs a program, found as a shell finds it, and waits for its end. It has a process group of its own, so that a
/// terminal's Ctrl-C does not end it half-way. Throws std::system_error when no process can be made.
[[nodiscard]] CommandOutput run_command(const std::vector<std::string>& command);

}  // namespace navcal::base
