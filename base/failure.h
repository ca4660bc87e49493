// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace navcal::base {

/// Exit statuses of every command (docs/cli.md).
enum class Exit : int { success = 0, failed = 1, usage = 2, bad_input = 3 };

/// Ends a command: the message goes to standard error, the status to the shell.
class Failure : public std::runtime_error {
 public:
  Failure(Exit status, const std::string& message) : std::runtime_error(message), status_(status) {}
  [[nodiscard]] Exit status() const { return status_; }

 private:
  Exit status_;
};

}  // namespace navcal::base
