// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace navcal::record {

/// Whether an output of this name is written in place: a device, a pipe, what /dev/stdout stands for. No file may
/// take the place of such a name.
[[nodiscard]] inline bool is_written_in_place(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (name.starts_with("/dev/std") || name.starts_with("/dev/fd/") || name.starts_with("/proc/")) return true;
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// A file that appears under its name only when it is whole: written beside it, then renamed. Left half-way,
/// nothing remains. A link keeps its place, and its target is replaced. Throws std::system_error, which names the
/// file.
class WholeFile {
 public:
  explicit WholeFile(std::filesystem::path path)
      : path_(std::move(path)), target_(target_of(path_)), part_(part_of(path_)),
        file_(std::fopen(part_.c_str(), "wbe")) {
    if (file_ == nullptr) fail();
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  ~WholeFile() {
    if (file_ == nullptr) return;
    std::fclose(file_);
    if (is_apart()) std::remove(part_.c_str());
  }

  /// The name under which the file is written until it is whole.
  [[nodiscard]] static std::filesystem::path part_of(const std::filesystem::path& path) {
    return is_written_in_place(path) ? path : std::filesystem::path(target_of(path).string() + ".part");
  }

  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail();
  }
  /// Everything is written.
  void commit() {
    std::FILE* const file = std::exchange(file_, nullptr);
    if (std::fclose(file) != 0 || (is_apart() && std::rename(part_.c_str(), target_.c_str()) != 0)) {
      const int reason = errno;
      if (is_apart()) std::remove(part_.c_str());
      throw std::system_error(reason, std::system_category(), path_.string());
    }
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The file that is being written, for libraries that open files themselves.
  [[nodiscard]] const std::filesystem::path& part() const { return part_; }

 private:
  static std::filesystem::path target_of(const std::filesystem::path& path) {
    std::error_code error;
    const auto target = std::filesystem::is_symlink(path, error) ? std::filesystem::canonical(path, error) : path;
    return error ? path : target;
  }
  [[nodiscard]] bool is_apart() const { return part_ != path_; }
  [[noreturn]] void fail() const { throw std::system_error(errno, std::system_category(), path_.string()); }

  std::filesystem::path path_, target_, part_;
  std::FILE* file_;
};

}  // namespace navcal::record
