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

/// A file that appears under its name only when it is whole: written beside it, then renamed. Left half-way,
/// nothing remains. Throws std::system_error, which names the file.
class WholeFile {
 public:
  explicit WholeFile(std::filesystem::path path)
      : path_(std::move(path)), part_(part_of(path_)), file_(std::fopen(part_.c_str(), "wbe")) {
    if (file_ == nullptr) fail();
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  ~WholeFile() {
    if (file_ == nullptr) return;
    std::fclose(file_);
    std::remove(part_.c_str());
  }

  /// The name under which the file is written until it is whole.
  [[nodiscard]] static std::filesystem::path part_of(const std::filesystem::path& path) {
    return path.string() + ".part";
  }

  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail();
  }
  /// Everything is written.
  void commit() {
    std::FILE* const file = std::exchange(file_, nullptr);
    if (std::fclose(file) != 0 || std::rename(part_.c_str(), path_.c_str()) != 0) {
      const int reason = errno;
      std::remove(part_.c_str());
      throw std::system_error(reason, std::system_category(), path_.string());
    }
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void fail() const { throw std::system_error(errno, std::system_category(), path_.string()); }

  std::filesystem::path path_;
  std::filesystem::path part_;
  std::FILE* file_;
};

}  // namespace navcal::record
