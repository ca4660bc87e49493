// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
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

/// A folder whose name says nothing, gone with its content. Throws std::system_error when none can be made.
class FreshFolder {
 public:
  FreshFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "navcal-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::system_category(), name);
    path_ = name;
  }
  FreshFolder(const FreshFolder&) = delete;
  FreshFolder& operator=(const FreshFolder&) = delete;
  ~FreshFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace navcal::validation
