// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

namespace navcal::record {

/// Temporary path for libraries that open files themselves. The file written at part() gets its name by commit();
/// without commit() it is removed.
class PartPath {
 public:
  explicit PartPath(std::filesystem::path path) : path_(std::move(path)), part_(path_.string() + ".part") {}
  PartPath(const PartPath&) = delete;
  PartPath& operator=(const PartPath&) = delete;
  ~PartPath() {
    if (!committed_) std::remove(part_.c_str());
  }

  /// The library has closed it. Throws std::system_error, which names the file.
  void commit() {
    if (std::rename(part_.c_str(), path_.c_str()) != 0) {
      throw std::system_error(errno, std::system_category(), path_.string());
    }
    committed_ = true;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::string& part() const { return part_; }

 private:
  std::filesystem::path path_;
  std::string part_;
  bool committed_ = false;
};

}  // namespace navcal::record
