// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace navcal::base {

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
