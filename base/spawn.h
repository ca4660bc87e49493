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

}  // namespace navcal::base
