// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace navcal::validation {

/// How a program ended that was run as a process of its own.
struct ChildEnd {
  enum class How : std::uint8_t { exited, signalled, timed_out, interrupted };
  How how = How::exited;
  int status = 0;  ///< of exit, or the signal
  double seconds = 0;
};

/// Runs the program in a process group of its own and waits for its end. Beyond `timeout`, and on Ctrl-C, the
/// whole group is asked to end, and killed when it does not within two seconds. Standard error goes to the file,
/// standard output nowhere; no other file is handed down. Throws std::system_error when it cannot be started.
[[nodiscard]] ChildEnd run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const std::filesystem::path& errors, std::chrono::milliseconds timeout);

}  // namespace navcal::validation
